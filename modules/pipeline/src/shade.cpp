// Lambert and Blinn-Phong over base colour textures, a sky for ambience, and the pictures made of them.

#include "detail.hpp"
#include "palette.hpp"
#include "tone.hpp"

#include <gnomon/pipeline/shade.hpp>

#include <gnomon/pipeline/measures.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::pipeline {

namespace {

/// The light's strength at a position, before the surface's angle: 1 / d^2 with glTF's windows for range and cone.
float falloff(Light const& light, math::vec3 const& light_position, math::vec3 const& position) noexcept {
    if (light.kind == LightKind::directional) return 1.0F;
    math::vec3 const to_light = light_position - position;
    float const d2 = std::fmax(glm::dot(to_light, to_light), 1e-8F);
    float strength = 1.0F / d2;
    if (math::is_finite(light.range_m)) {
        float const ratio = d2 / (light.range_m * light.range_m);
        strength *= std::clamp(1.0F - ratio * ratio, 0.0F, 1.0F);
    }
    if (light.kind == LightKind::spot) {
        math::vec3 const axis = math::to_float(glm::normalize(light.direction));
        float const cosine = -glm::dot(axis, to_light) / std::sqrt(d2);
        float const outer = std::cos(light.outer_cone_rad);
        float const inner = std::cos(std::min(light.inner_cone_rad, light.outer_cone_rad));
        float const t = std::clamp((cosine - outer) / std::fmax(inner - outer, 1e-4F), 0.0F, 1.0F);
        strength *= t * t;
    }
    return strength;
}

/// Light that falls on a sample if nothing blocks it, as the exposure sees it.
std::vector<float> unshadowed(Frame const& frame, core::ExecutorRef executor) {
    std::vector<float> e(frame.samples.size());
    executor.parallel_for(e.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            math::vec3 const& p = frame.samples.position[i];
            float const cosine = std::fmax(0.0F, glm::dot(frame.samples.shading_normal[i], toward_light(frame, p)));
            e[i] = cosine * falloff(frame.light, frame.light_position, p);
        }
    });
    return e;
}

/// The light on a well lit surface: full sun, or what the brighter quarter of the lamp-lit samples gets.
float key_light(Frame const& frame, core::ExecutorRef executor) {
    float const strength = std::fmax(luminance(frame.light.color) * frame.light.intensity, 1e-20F);
    if (frame.light.kind == LightKind::directional) return strength;
    std::vector<double> lit;
    for (float const e : unshadowed(frame, executor))
        if (e > 0.0F) lit.push_back(static_cast<double>(e));
    double const key = lit.empty() ? 1.0 : percentile(lit, 0.75);
    return strength * static_cast<float>(key);
}

math::vec3 sky_at(Frame const& frame, std::size_t pixel) noexcept {
    auto const width = static_cast<std::size_t>(frame.view.size_px.x);
    math::dvec2 const px(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5);
    auto const up = static_cast<float>(glm::normalize(math::pixel_ray(frame.view, px).step).y);
    float const t = std::sqrt(std::clamp(up, 0.0F, 1.0F));
    math::vec3 const horizon(0.80F, 0.87F, 0.94F);
    math::vec3 const zenith(0.24F, 0.43F, 0.75F);
    math::vec3 const below(0.55F, 0.57F, 0.60F);
    if (up < 0.0F) return horizon + (below - horizon) * std::fmin(1.0F, -6.0F * up);
    return horizon + (zenith - horizon) * t;
}

math::vec3 displayed(Shading const& shading, std::size_t i, float visibility) noexcept {
    math::vec3 const radiance = (shading.ambient[i] + shading.direct[i] * visibility) * shading.exposure;
    return tone_mapped(radiance);
}

template <class Color>
Image painted(Frame const& frame, Color&& color_of_sample, float sky_grey) {
    Image image{frame.view.size_px, std::vector<std::uint8_t>(pixel_count(frame.view.size_px) * 3)};
    for (std::size_t pixel = 0; pixel < frame.sample_of_pixel.size(); ++pixel) {
        std::uint32_t const i = frame.sample_of_pixel[pixel];
        if (i != no_sample) {
            put(image, pixel, color_of_sample(std::size_t{i}));
        } else {
            math::vec3 const sky = sky_at(frame, pixel);
            put(image, pixel, sky + (math::vec3(0.85F) - sky) * sky_grey);
        }
    }
    return image;
}

/// The sky's light on a surface: bluish from above, earthy from below, and a little stronger from the light's side, so
/// that the walls of a house differ in its shadow too.
math::vec3 ambient_at(ShadeConfig const& config, math::vec3 const& normal, math::vec3 const& to_light) noexcept {
    float const upward = 0.5F + 0.5F * normal.y;
    float const side = 1.0F + 0.3F * (normal.x * to_light.x + normal.z * to_light.z) + 0.1F * normal.x;
    return (config.ground_color * (1.0F - upward) + config.sky_color * upward) * side;
}

/// The exposure that shows the light's key as white paper, moved by up to a stop and a half toward an even picture.
float picked_exposure(Frame const& frame, Shading const& shading, float key) {
    std::size_t const n = frame.samples.size();
    if (n == 0) return 1.0F / key;
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        float const lit = has_truth(frame) ? static_cast<float>(frame.lit[i]) : 0.5F;  // Nobody knows: half of it.
        math::vec3 const arriving = shading.ambient[i] + shading.direct[i] * lit;
        sum += std::fmin(static_cast<double>(luminance(arriving) / key), 4.0);
    }
    constexpr float middle = 0.22F;
    float const mean = static_cast<float>(sum / static_cast<double>(n));
    return std::clamp(middle / std::fmax(mean, 1e-6F), 0.7F, 2.2F) / key;
}

}  // namespace

math::vec3 toward_light(Frame const& frame, math::vec3 const& position) noexcept {
    math::vec3 const to = frame.light.kind == LightKind::directional ? frame.to_light : frame.light_position - position;
    float const length = std::sqrt(glm::dot(to, to));
    return length > 0.0F ? to / length : math::vec3(0.0F, 1.0F, 0.0F);
}

Shading shade(Frame const& frame, ShadeConfig const& config, core::ExecutorRef executor) {
    std::size_t const n = frame.samples.size();
    Shading shading{std::vector<math::vec3>(n), std::vector<math::vec3>(n), config.exposure, config};
    Palette const palette(frame);
    float const key = key_light(frame, executor);
    math::vec3 const eye = math::to_float(frame.view.eye_m - frame.geometry->origin_m);
    bool const ortho = frame.view.lens == math::Lens::orthographic;
    math::vec3 const light = frame.light.color * frame.light.intensity;
    executor.parallel_for(n, sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            math::vec3 const& p = frame.samples.position[i];
            math::vec3 const& normal = frame.samples.shading_normal[i];
            math::vec3 const sight = ortho ? math::to_float(frame.view.back) : eye - p;
            float const distance = std::fmax(std::sqrt(glm::dot(sight, sight)), 1e-6F);
            math::vec3 const to_eye = sight / distance;
            math::dvec2 const pixel_m = math::pixel_size_m(frame.view, static_cast<double>(distance));
            math::vec3 const albedo = palette.base_color(i, static_cast<float>(std::fmax(pixel_m.x, pixel_m.y)),
                                                         std::abs(glm::dot(frame.samples.normal[i], to_eye)));
            math::vec3 const to_light = toward_light(frame, p);
            float const lambert = std::fmax(0.0F, glm::dot(normal, to_light));
            math::vec3 half = to_light + to_eye;
            half = half / std::fmax(std::sqrt(glm::dot(half, half)), 1e-6F);
            float const gloss = std::pow(std::fmax(0.0F, glm::dot(normal, half)), config.shininess);
            float const highlight = lambert > 0.0F ? config.specular * (config.shininess + 8.0F) / 8.0F * gloss : 0.0F;
            float const strength = falloff(frame.light, frame.light_position, p) * lambert;
            shading.direct[i] = light * strength * (albedo + math::vec3(highlight));
            math::vec3 const sky = ambient_at(config, normal, to_light);
            shading.ambient[i] = albedo * sky * (config.ambient * key) + palette.material(i).emissive * key;
        }
    });
    if (!(config.exposure > 0.0F)) shading.exposure = picked_exposure(frame, shading, key);
    return shading;
}

std::vector<float> exact_visibility(Frame const& frame) {
    std::vector<float> visibility(frame.lit.size());
    for (std::size_t i = 0; i < visibility.size(); ++i) visibility[i] = frame.lit[i] != 0 ? 1.0F : 0.0F;
    return visibility;
}

Image picture(Frame const& frame, Shading const& shading, std::span<float const> visibility) {
    return painted(
        frame, [&](std::size_t i) { return displayed(shading, i, visibility[i]); }, 0.0F);
}

Image tinted_picture(Frame const& frame, Shading const& shading, std::span<float const> visibility,
                     std::span<math::vec3 const> tint) {
    auto const color = [&](std::size_t i) {
        // Most of the surface's own colour goes: the tint is to be read, the scene to be recognized.
        math::vec3 const own = displayed(shading, i, visibility[i]);
        bool const plain = tint[i] == math::vec3(1.0F);
        return plain ? own : (math::vec3(luminance(own)) * 0.9F + math::vec3(0.1F)) * tint[i];
    };
    return painted(frame, color, 0.0F);
}

Image error_overlay(Frame const& frame, Shading const& shading, std::span<float const> visibility) {
    auto const color = [&](std::size_t i) {
        Verdict const verdict = verdict_of(visibility[i], frame.lit[i]);
        if (verdict == Verdict::false_lit) return false_lit_color;
        if (verdict == Verdict::false_shadow) return false_shadow_color;
        // Grey, lifted and flattened, so that the two colours stand out in light and in shadow.
        return math::vec3(0.12F + 0.60F * luminance(displayed(shading, i, visibility[i])));
    };
    return painted(frame, color, 1.0F);
}

double radiance_error(Frame const& frame, Shading const& shading, std::span<float const> visibility) {
    double difference = 0.0;
    double exact = 0.0;
    for (std::size_t i = 0; i < frame.lit.size(); ++i) {
        float const truth = frame.lit[i] != 0 ? 1.0F : 0.0F;
        for (int c = 0; c < 3; ++c) {
            auto const direct = static_cast<double>(shading.direct[i][c]);
            double const e = direct * static_cast<double>(visibility[i] - truth);
            double const r = static_cast<double>(shading.ambient[i][c]) + direct * static_cast<double>(truth);
            difference += e * e;
            exact += r * r;
        }
    }
    return exact > 0.0 ? std::sqrt(difference / exact) : 0.0;
}

}  // namespace gnomon::pipeline
