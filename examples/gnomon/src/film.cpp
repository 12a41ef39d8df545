#include "film.hpp"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

namespace gnomon::command {

namespace {

struct DeleteEncoder {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

}  // namespace

struct Film::Encoder {
    FilmConfig config;
    WebPConfig quality{};
    std::unique_ptr<WebPAnimEncoder, DeleteEncoder> webp;
    int frames = 0;
    bool failed = false;

    /// Rounded from the start of the film, so that no rate drifts.
    [[nodiscard]] int time_ms(int frame) const {
        return static_cast<int>(std::lround(static_cast<double>(frame) * 1000.0 / config.rate_hz));
    }
};

Film::Film(FilmConfig const& config) : encoder_(std::make_unique<Encoder>()) {
    encoder_->config = config;
    WebPAnimEncoderOptions options;
    encoder_->failed = WebPAnimEncoderOptionsInit(&options) == 0 ||
                       WebPConfigPreset(&encoder_->quality, WEBP_PRESET_PICTURE, config.quality) == 0;
    if (encoder_->failed) return;
    encoder_->quality.method = 3;  // A third of the default's time for a few percent more bytes.
    options.kmin = 9;
    options.kmax = 17;
    encoder_->webp.reset(WebPAnimEncoderNew(config.size_px.x, config.size_px.y, &options));
    encoder_->failed = encoder_->webp == nullptr;
}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

bool Film::add(Picture const& picture) {
    Encoder& e = *encoder_;
    bool const fits = picture.channels == 3 && picture.size_px == e.config.size_px;
    if (e.failed || !fits) return false;
    WebPPicture frame;
    e.failed = WebPPictureInit(&frame) == 0;
    if (e.failed) return false;
    frame.width = picture.size_px.x;
    frame.height = picture.size_px.y;
    frame.use_argb = 1;
    e.failed = WebPPictureImportRGB(&frame, picture.pixels.data(), picture.size_px.x * 3) == 0 ||
               WebPAnimEncoderAdd(e.webp.get(), &frame, e.time_ms(e.frames), &e.quality) == 0;
    WebPPictureFree(&frame);
    e.frames += e.failed ? 0 : 1;
    return !e.failed;
}

Bytes Film::finish() {
    Encoder& e = *encoder_;
    if (e.failed || e.frames == 0) return {};
    WebPData data;
    WebPDataInit(&data);
    // A null frame ends the last picture's time.
    bool const whole = WebPAnimEncoderAdd(e.webp.get(), nullptr, e.time_ms(e.frames), nullptr) != 0 &&
                       WebPAnimEncoderAssemble(e.webp.get(), &data) != 0;
    Bytes bytes = whole ? Bytes(data.bytes, data.bytes + data.size) : Bytes{};
    WebPDataClear(&data);
    e.failed = true;  // Nothing can be added any more.
    return bytes;
}

}  // namespace gnomon::command
