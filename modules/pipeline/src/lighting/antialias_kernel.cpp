// The kernel `shade_samples`: its C++ half.

#include <shaders/shade_samples_comp.hpp>

#include <gnomon/lights/lists.hpp>
#include <gnomon/lights/shade.hpp>

#include "antialias_kernels.hpp"
#include "surface_table.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

namespace {

struct SampledPixels {
    ShadeSamplesStd constants;
    SurfaceData surfaces;
    std::span<lights::ShadedLight const> lights;
    std::span<lights::Cell const> cells;
    std::span<std::uint32_t const> indices;
    backend::TexelView ids;

    /// The light of a triangle at an image point, and how many lights were evaluated.
    [[nodiscard]] math::vec4 lit(std::uint32_t triangle, math::vec2 const& px, lights::Cell const& cell) const noexcept {
        SurfaceStd const s = surfaces.at(triangle, px);
        using Vec3 = formula::Vec3<float>;
        formula::GnRayCamera const& camera = surfaces.rays.camera;
        Vec3 const p(s.position);
        Vec3 const to_eye = camera.perspective != 0 ? gn_unit_or_up(Vec3(camera.eye) - p) : -Vec3(camera.forward);
        formula::GnSurface<float> const surface{p, Vec3(s.normal), to_eye, Vec3(s.diffuse), Vec3(s.specular), s.shininess};
        Vec3 sum(s.emissive);
        for (std::uint32_t const index : indices.subspan(cell.offset, cell.count)) sum = sum + gn_shade(lights[index], surface);
        return {sum.x.v, sum.y.v, sum.z.v, static_cast<float>(cell.count)};
    }

    [[nodiscard]] math::vec4 shade(std::uint32_t x, std::uint32_t y) const noexcept {
        lights::Cell const cell = cells[std::size_t{y / constants.tile} * constants.columns + x / constants.tile];
        std::uint32_t id[antialias_samples];
        for (std::uint32_t s = 0; s < antialias_samples; ++s)
            id[s] = ids.layer<std::uint32_t>(s)[std::size_t{y} * constants.width + x];
        bool const one = id[0] == id[1] && id[0] == id[2] && id[0] == id[3];
        bool const each_sample = constants.edges_only != 0 && !one;
        math::vec2 const corner(static_cast<float>(x), static_cast<float>(y));
        math::vec4 sum(0.0F);
        for (std::uint32_t s = 0; s < antialias_samples; ++s) {
            if (id[s] == backend::no_triangle) continue;
            float share = 0.25F;
            bool shaded = false;
            for (std::uint32_t k = 0; k < antialias_samples && !each_sample; ++k) {
                shaded = shaded || (k < s && id[k] == id[s]);
                if (k > s && id[k] == id[s]) share += 0.25F;
            }
            if (shaded) continue;
            math::vec4 const light = lit(id[s], corner + (each_sample ? sample_px[s] : math::vec2(0.5F)), cell);
            sum = sum + math::vec4(light.x * share, light.y * share, light.z * share, light.w);
        }
        return sum;
    }
};

void shade_sampled(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ShadeSamplesStd>();
    SampledPixels const pixels{c,
                               {data.buffer<VertexStd const>(0), data.buffer<TriangleStd const>(1), data.buffer<MaterialStd const>(2),
                                data.buffer<std::uint32_t const>(3), data.buffer<CameraRays const>(4)[0]},
                               data.buffer<lights::ShadedLight const>(5),
                               data.buffer<lights::Cell const>(6),
                               data.buffer<std::uint32_t const>(7),
                               data.targets[0]};
    auto const colors = data.buffer<math::vec4>(8);
    for (std::size_t i = begin; i < end; ++i)
        colors[i] = pixels.shade(static_cast<std::uint32_t>(i % c.width), static_cast<std::uint32_t>(i / c.width));
}

}  // namespace

constinit backend::Kernel const shade_samples_kernel{.name = "shade_samples",
                                                     .cpu = &shade_sampled,
                                                     .spirv = shade_samples_comp,
                                                     .buffers = 9,
                                                     .targets = 1,
                                                     .constant_bytes = sizeof(ShadeSamplesStd),
                                                     .grain = 1024};

}  // namespace gnomon::pipeline
