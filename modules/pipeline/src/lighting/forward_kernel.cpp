// The fragment kernel `forward`: its C++ half.

#include <shaders/forward_frag.hpp>

#include <gnomon/lights/shade.hpp>

#include "forward_kernels.hpp"
#include "shade_lanes.hpp"
#include "surface_table.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

namespace {

/// lights::Cell.
struct ForwardCell {
    std::uint32_t offset;
    std::uint32_t count;
};

struct ForwardShading {
    ForwardStd constants;
    SurfaceData surfaces;
    std::span<lights::ShadedLight const> lights;
    std::span<float const> slice_depth_m;
    std::span<ForwardCell const> cells;
    std::span<std::uint32_t const> indices;
    backend::TexelView ids;
    ShadedSamples eye;  ///< Where lanes look for the eye.

    explicit ForwardShading(backend::KernelData const& data)
        : constants(data.constant<ForwardStd>()),
          surfaces{data.buffer<VertexStd const>(0), data.buffer<TriangleStd const>(1), data.buffer<MaterialStd const>(2),
                   data.buffer<std::uint32_t const>(3), data.buffer<CameraRays const>(4)[0]},
          lights(data.buffer<lights::ShadedLight const>(5)),
          slice_depth_m(data.buffer<float const>(6)),
          cells(data.buffer<ForwardCell const>(7)),
          indices(data.buffer<std::uint32_t const>(8)),
          ids(data.targets[0]) {
        bool const perspective = surfaces.rays.camera.perspective != 0;
        eye.orthographic = !perspective;
        eye.eye = perspective ? surfaces.rays.camera.eye : -surfaces.rays.camera.forward;
    }

    [[nodiscard]] bool is_hidden(backend::Fragment const& f) const noexcept {
        std::size_t const at = std::size_t{f.y} * static_cast<std::size_t>(ids.size_px.x) + f.x;
        return constants.once != 0 && ids.layer<std::uint32_t>(0)[at] != f.triangle;
    }
    [[nodiscard]] std::uint32_t slice_at(float depth_m) const noexcept {
        std::uint32_t first = 0;
        for (std::uint32_t count = constants.slices; count > 1;) {
            std::uint32_t const upper = count / 2;
            bool const beyond = depth_m >= slice_depth_m[first + upper];
            first = beyond ? first + upper : first;
            count = beyond ? count - upper : upper;
        }
        return first;
    }
    [[nodiscard]] std::uint32_t cell_at(backend::Fragment const& f, math::vec3 const& position) const noexcept {
        using Vec3 = formula::Vec3<float>;
        formula::GnRayCamera const& camera = surfaces.rays.camera;
        float const depth_m = gn_dot(Vec3(position) - Vec3(camera.eye), Vec3(camera.forward)).v;
        std::uint32_t const column = std::min(f.x / constants.tile, constants.columns - 1);
        std::uint32_t const row = std::min(f.y / constants.tile, constants.rows - 1);
        return (slice_at(depth_m) * constants.rows + row) * constants.columns + column;
    }
};

/// Fragments of one cell that wait for a full group.
template <std::size_t N>
struct FragmentGroup {
    SampleLanes<N> lanes;
    std::size_t place[N];
    float opacity[N];
    std::size_t count = 0;
    std::uint32_t cell = 0;

    void add(SurfaceStd const& s, std::size_t at) noexcept {
        // Lanes beyond the last repeat it.
        for (std::size_t k = count; k < N; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                lanes.position[axis][k] = s.position[axis];
                lanes.normal[axis][k] = s.normal[axis];
                lanes.diffuse[axis][k] = s.diffuse[axis];
                lanes.specular[axis][k] = s.specular[axis];
                lanes.emissive[axis][k] = s.emissive[axis];
            }
            lanes.shininess[k] = s.shininess;
        }
        opacity[count] = s.opacity;
        place[count++] = at;
    }
};

template <std::size_t N>
[[gnu::always_inline]] inline void shade_fragments(ForwardShading const& s, FragmentGroup<N>& group,
                                                   std::span<backend::FragmentColor> out) noexcept {
    if (group.count == 0) return;
    auto const surface = surface_of(group.lanes, s.eye);
    auto sum = lanes_of(group.lanes.emissive);
    ForwardCell const cell = s.cells[group.cell];
    if (s.constants.counts == 0)
        for (std::uint32_t const index : s.indices.subspan(cell.offset, cell.count)) sum = sum + gn_shade(s.lights[index], surface);
    float color[3][N];
    sum.x.v.store(color[0]);
    sum.y.v.store(color[1]);
    sum.z.v.store(color[2]);
    for (std::size_t k = 0; k < group.count; ++k) {
        float const scale = s.constants.blends != 0 ? group.opacity[k] : 1.0F;
        float const alpha = s.constants.blends != 0 ? group.opacity[k] : static_cast<float>(cell.count);
        out[group.place[k]].color = {color[0][k] * scale, color[1][k] * scale, color[2][k] * scale, alpha};
    }
    group.count = 0;
}

template <std::size_t N>
[[gnu::always_inline]] inline void shade_all(ForwardShading const& s, std::span<backend::Fragment const> fragments,
                                             std::span<backend::FragmentColor> out) noexcept {
    FragmentGroup<N> group;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        backend::Fragment const& f = fragments[i];
        out[i].discarded = s.is_hidden(f);
        if (out[i].discarded) continue;
        SurfaceStd const surface = s.surfaces.at(f.triangle, {static_cast<float>(f.x) + 0.5F, static_cast<float>(f.y) + 0.5F});
        std::uint32_t const cell = s.cell_at(f, surface.position);
        if (group.count == N || cell != group.cell) shade_fragments(s, group, out);
        group.cell = cell;
        group.add(surface, i);
    }
    shade_fragments(s, group, out);
}

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
[[gnu::target("avx2"), gnu::flatten]] void shade_all_avx2(ForwardShading const& s, std::span<backend::Fragment const> fragments,
                                                          std::span<backend::FragmentColor> out) noexcept {
    shade_all<8>(s, fragments, out);
}
#endif

void forward(backend::KernelData const& data, std::span<backend::Fragment const> fragments, std::span<backend::FragmentColor> out) {
    ForwardShading const s(data);
#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return shade_all_avx2(s, fragments, out);
#endif
    shade_all<4>(s, fragments, out);
}

}  // namespace

constinit backend::FragmentKernel const forward_kernel{.name = "forward",
                                                       .cpu = &forward,
                                                       .spirv = forward_frag,
                                                       .buffers = forward_buffers,
                                                       .targets = 1,
                                                       .constant_bytes = sizeof(ForwardStd)};

}  // namespace gnomon::pipeline
