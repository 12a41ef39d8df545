#include "gbuffer.hpp"

#include <gnomon/lights/shade.hpp>
#include <gnomon/math/half.hpp>

#include "../detail.hpp"
#include "../palette.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::pipeline {

namespace {

/// What no light reaches still shows a little: a share of the base colour.
constexpr float ambient = 0.01F;

/// The exponent 2^k of a roughness: Beckmann's 2 / alpha^2 - 2 with alpha = roughness^2.
float shininess_of(float roughness) noexcept {
    float const alpha = std::clamp(roughness, 0.05F, 1.0F) * std::clamp(roughness, 0.05F, 1.0F);
    float const exponent = std::fmax(2.0F / (alpha * alpha) - 2.0F, 1.0F);
    return std::clamp(std::round(std::log2(exponent)), 0.0F, 10.0F);
}

GBufferTexel texel_of(Frame const& frame, Palette const& palette, std::size_t i, math::vec3 const& eye) noexcept {
    bool const ortho = frame.view.lens == math::Lens::orthographic;
    math::vec3 const sight = ortho ? math::to_float(frame.view.back) : eye - frame.samples.position[i];
    float const distance = std::fmax(std::sqrt(glm::dot(sight, sight)), 1e-6F);
    math::dvec2 const pixel_m = math::pixel_size_m(frame.view, static_cast<double>(distance));
    float const cosine = std::abs(glm::dot(frame.samples.normal[i], sight / distance));
    scene::Material const& material = palette.material(i);
    math::vec3 const base = palette.base_color(i, static_cast<float>(std::fmax(pixel_m.x, pixel_m.y)), cosine);
    float const metallic = std::clamp(material.metallic, 0.0F, 1.0F);
    float const shininess = shininess_of(material.roughness);
    math::vec3 const diffuse = base * (1.0F - metallic);
    math::vec3 const specular = math::vec3(0.04F) + (base - math::vec3(0.04F)) * metallic;
    math::vec3 const scaled = specular * lights::highlight_scale(static_cast<int>(shininess));
    math::vec3 const emissive = material.emissive + base * ambient;
    math::vec3 const& n = frame.samples.shading_normal[i];
    return {{n.x, n.y, n.z},          0.0F,      {diffuse.x, diffuse.y, diffuse.z},    0.0F,
            {scaled.x, scaled.y, scaled.z}, shininess, {emissive.x, emissive.y, emissive.z}, 0.0F};
}

void store(GBufferTexel const& texel, GBufferFormat format, std::uint32_t* out) noexcept {
    float numbers[16];
    std::memcpy(numbers, &texel, sizeof numbers);
    if (format == GBufferFormat::f32) {
        std::memcpy(out, numbers, sizeof numbers);
        return;
    }
    for (std::size_t k = 0; k < 8; ++k)
        out[k] = math::half_of_float(numbers[2 * k]) | static_cast<std::uint32_t>(math::half_of_float(numbers[2 * k + 1])) << 16U;
}

}  // namespace

std::vector<std::uint32_t> make_gbuffer(Frame const& frame, GBufferFormat format, core::ExecutorRef executor) {
    std::vector<std::uint32_t> words(frame.samples.size() * words_of(format));
    Palette const palette(frame);
    math::vec3 const eye = math::to_float(frame.view.eye_m - frame.geometry->origin_m);
    executor.parallel_for(frame.samples.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            store(texel_of(frame, palette, i, eye), format, words.data() + i * words_of(format));
    });
    return words;
}

}  // namespace gnomon::pipeline
