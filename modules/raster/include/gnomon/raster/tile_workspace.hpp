#pragma once
// Memory of the passes that have a record layout of their own: `conservative_pass`, `ortho_pass`.

#include <cstddef>
#include <memory>

namespace gnomon::raster {

/// Memory that such a pass works in. Kept between passes it stops growing: after warm-up nothing is allocated.
///
/// One pass at a time. About 80 bytes a triangle that is drawn.
class TileWorkspace {
  public:
    TileWorkspace();
    ~TileWorkspace();
    TileWorkspace(TileWorkspace&&) noexcept;
    TileWorkspace& operator=(TileWorkspace&&) noexcept;

    [[nodiscard]] std::size_t size_bytes() const noexcept;
    struct State;
    [[nodiscard]] State& state() noexcept { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::raster
