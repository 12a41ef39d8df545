// The kernel `ray`: its C++ half, the exact trace over buffers.

#include "kernels.hpp"

#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/visibility.hpp>
#include <shaders/ray_comp.hpp>

#include <algorithm>
#include <span>

namespace gnomon::pipeline {

namespace {

template <class T>
std::span<T const> first(backend::KernelData const& data, std::size_t buffer, std::size_t count) noexcept {
    auto const all = data.buffer<T const>(buffer);
    return all.first(std::min(count, all.size()));
}

/// trace::AlphaTest over packed materials and textures.
struct PackedOpacity {
    std::span<std::uint32_t const> material_of;
    std::span<RayMaterialStd const> materials;
    std::span<RayTextureStd const> textures;
    std::span<std::uint8_t const> texels;
    std::span<math::vec2 const> corner_uv;

    [[nodiscard]] bool operator()(trace::Crossing const& crossing) const noexcept {
        std::size_t const id = crossing.triangle.index();
        if (id >= material_of.size() || material_of[id] >= materials.size()) return true;
        RayMaterialStd const& m = materials[material_of[id]];
        if (m.is_masked == 0) return true;
        math::AlphaTexture texture;
        if (m.texture < textures.size()) texture = unpacked(textures[m.texture]);
        return trace::is_solid({true, m.factor, m.cutoff, 0}, {&texture, 1}, trace::uv_at(crossing, corner_uv));
    }

    [[nodiscard]] math::AlphaTexture unpacked(RayTextureStd const& t) const noexcept {
        return {texels.subspan(std::min<std::size_t>(t.first_byte, texels.size())), math::ivec2(t.width, t.height),
                static_cast<math::Wrap>(t.modes & 0xFFU), static_cast<math::Wrap>(t.modes >> 8U & 0xFFU),
                static_cast<std::int32_t>(t.modes >> 16U)};
    }
};

predicates::Target target_of(float const (&xyz)[3], std::uint32_t at_infinity) noexcept {
    return {math::vec3(xyz[0], xyz[1], xyz[2]), at_infinity != 0};
}

template <class F>
void trace_range(backend::KernelData const& data, RayStd const& c, F const& opacity, std::size_t begin,
                 std::size_t end) {
    auto const blocks = data.buffer<trace::Block const>(1);
    trace::BvhView const bvh(first<trace::Node>(data, 0, c.nodes), blocks);
    predicates::TriangleList const list{first<math::vec3>(data, 2, c.positions),
                                        first<math::uvec3>(data, 3, c.triangles)};
    trace::VisibilityConfig<F> const config{target_of(c.light, c.light_at_infinity),
                                            trace::OwnPlane{list, target_of(c.eye, c.eye_at_infinity)}, opacity};
    auto const samples = data.buffer<sample::ViewSample const>(4);
    auto const reached = data.buffer<std::uint8_t const>(5);
    auto const answers = data.buffer<RayAnswer>(11);
    trace::VisibilityStats stats;
    for (std::size_t i = begin; i < end; ++i)
        answers[i] =
            reached[i] == 0 || trace::is_shadowed(bvh, samples[i], config, stats) ? RayAnswer::shadow : RayAnswer::lit;
}

void trace_rays(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<RayStd>();
    if (c.masked == 0) {
        trace_range(data, c, trace::Solid{}, begin, end);
        return;
    }
    PackedOpacity const opacity{first<std::uint32_t>(data, 6, c.material_of),
                                first<RayMaterialStd>(data, 7, c.materials), first<RayTextureStd>(data, 8, c.textures),
                                data.buffer<std::uint8_t const>(9), first<math::vec2>(data, 10, c.corner_uv)};
    trace_range(data, c, opacity, begin, end);
}

}  // namespace

constinit backend::Kernel const ray_kernel{.name = "ray",
                                           .cpu = &trace_rays,
                                           .spirv = ray_comp,
                                           .buffers = 12,
                                           .constant_bytes = sizeof(RayStd),
                                           .grain = 1024};

}  // namespace gnomon::pipeline
