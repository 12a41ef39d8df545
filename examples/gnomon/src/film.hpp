#pragma once
// Pictures in a row as one animated WebP, which every browser plays.

#include "image_io.hpp"

#include <memory>

namespace gnomon::command {

struct FilmConfig {
    math::ivec2 size_px{0, 0};
    double rate_hz = 30.0;
    float quality = 82.0F;  ///< 0 to 100; lossy.
};

class Film {
  public:
    explicit Film(FilmConfig const& config);
    ~Film();
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;

    /// expects: three channels, of the film's size.
    /// returns: false when the encoder gave up (memory, a size beyond 16383 px); the film then stays empty.
    bool add(Picture const& picture);

    /// The file's bytes; empty for a film without frames or one that failed.
    [[nodiscard]] Bytes finish();

  private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace gnomon::command
