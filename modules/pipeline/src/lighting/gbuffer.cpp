#include "gbuffer.hpp"

#include <gnomon/lights/shade.hpp>
#include <gnomon/math/half.hpp>

#include "../detail.hpp"
#include "surface_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::pipeline {

namespace {

/// The surface of a sample, its material read by the formulas that fragment shaders use.
GBufferTexel texel_of(Frame const& frame, MaterialTable const& table, std::size_t i, CameraRays const& rays) noexcept {
    std::uint32_t const triangle = frame.samples.triangle[i];
    MaterialStd const& m = table.materials[frame.geometry->triangle_material[triangle]];
    formula::GnTriangle<float> const t = triangle_of(*frame.geometry, triangle);
    using Vec3 = formula::Vec3<float>;
    math::vec2 const uv = frame.samples.uv[i];
    formula::GnSurfacePoint<float> const at{Vec3(frame.samples.position[i]), Vec3(frame.samples.normal[i]),
                                            Vec3(frame.samples.shading_normal[i]), formula::Vec2<float>(uv)};
    using Float = formula::Float<float>;
    auto const density = gn_texels_per_pixel(rays.camera, rays.pixel_m, t, at, size_of(m));
    math::vec4 const base = base_color_of(m, table.texels, at.uv, density);
    auto const r = gn_reflectance(Vec3(base.x, base.y, base.z), Float(m.metallic), Float(m.scale),
                                  Vec3(m.emissive[0], m.emissive[1], m.emissive[2]));
    math::vec3 const& n = frame.samples.shading_normal[i];
    return {{n.x, n.y, n.z},
            0.0F,
            {r.diffuse.x.v, r.diffuse.y.v, r.diffuse.z.v},
            0.0F,
            {r.specular.x.v, r.specular.y.v, r.specular.z.v},
            m.shininess,
            {r.emissive.x.v, r.emissive.y.v, r.emissive.z.v},
            0.0F};
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
    std::vector<std::uint8_t> seen(frame.scene->materials.size(), 0);
    for (std::uint32_t const triangle : frame.samples.triangle) seen[frame.geometry->triangle_material[triangle]] = 1;
    MaterialTable const table(*frame.scene, seen);
    CameraRays const rays = make_camera_rays(frame.view, frame.geometry->origin_m);
    executor.parallel_for(frame.samples.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            store(texel_of(frame, table, i, rays), format, words.data() + i * words_of(format));
    });
    return words;
}

}  // namespace gnomon::pipeline
