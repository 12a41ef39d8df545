#pragma once
// The question of this module as a GPU asks it: in float, with a third answer. What is not `unsure` is the exact
// answer, whatever the device rounds and flushes; the few that are unsure go to `is_blocked`.
//
// The formulas, and the proof of their bounds, are in formula/*.glsl, which shaders include;
// here they are C++, over any scalar type. On the CPU `is_blocked` is faster: this is what a shader is tested against.

#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/trace/alpha.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/formula/mask.glsl>
#include <gnomon/trace/formula/own_plane.glsl>
#include <gnomon/trace/segment.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gnomon::trace {

// Shaders read nodes and blocks as rows of four words: lo and hi by axis, children; corners by axis, ids.
static_assert(offsetof(Node, lo) == 0 && offsetof(Node, hi) == 48 && offsetof(Node, child) == 96 &&
              sizeof(Node) == 128);
static_assert(offsetof(Block, corner) == 0 && offsetof(Block, id) == 144 && sizeof(Block) == 160);

/// The values are those of the formulas.
enum class Answer : std::uint8_t {
    free = 0,
    blocked = 1,
    unsure = 2,
};

/// Coordinates may be so large, in metres; beyond that everything is unsure.
inline constexpr float max_filter_coordinate = 0x1p28F;

/// Subtrees that may wait while the filter walks a hierarchy; beyond that a segment is unsure, if nothing blocks it.
inline constexpr std::size_t filter_stack = 64;

namespace detail {

/// In the frame's order of axes.
template <class S>
[[nodiscard]] formula::Vec3<S> renamed(formula::GnRay<S> const& ray, math::vec3 const& p) noexcept {
    return {S(p[ray.axis_x.v]), S(p[ray.axis_y.v]), S(p[ray.axis_z.v])};
}

template <class S>
[[nodiscard]] formula::Vec3<S> spread(math::vec3 const& p) noexcept {
    return {S(p.x), S(p.y), S(p.z)};
}

[[nodiscard]] inline bool in_range(math::vec3 const& p) noexcept {
    return formula::gn_in_range<float>(formula::Vec3<float>(p)).v;
}

template <class S>
[[nodiscard]] formula::GnRay<S> make_ray(Segment const& s) noexcept {
    bool const legal = is_valid(s) && in_range(s.start) && (s.end.at_infinity || in_range(s.end.xyz));
    math::vec3 const nowhere(0.0F);
    auto const end = spread<S>(legal ? s.end.xyz : nowhere);
    auto ray = formula::gn_make_ray<S>(spread<S>(legal ? s.start : nowhere),
                                       s.end.at_infinity ? formula::gn_scaled<S>(end) : end,
                                       formula::Bool<S>(!s.end.at_infinity));
    ray.usable = ray.usable && formula::Bool<S>(legal);
    return ray;
}

template <class S>
[[nodiscard]] formula::GnMeeting<S> meet(formula::GnRay<S> const& ray, Triangle const& t) noexcept {
    return formula::gn_meet<S>(ray, renamed(ray, t[0]), renamed(ray, t[1]), renamed(ray, t[2]));
}

template <class S>
[[nodiscard]] Answer filter_separates(Triangle const& t, predicates::Target const& eye, Light const& light) noexcept {
    auto const side_of = [&](predicates::Target const& to) noexcept {
        bool const legal = is_valid(to) && (to.at_infinity || in_range(to.xyz));
        auto const xyz = spread<S>(legal ? to.xyz : math::vec3(0.0F));
        auto const at = to.at_infinity ? formula::gn_scaled<S>(xyz) : xyz;
        auto const side =
            formula::gn_plane_side<S>(spread<S>(t[0]), spread<S>(t[1]), spread<S>(t[2]), at, !to.at_infinity);
        return legal ? side : formula::Int<S>(2);
    };
    return static_cast<Answer>(formula::gn_turned_away<S>(side_of(eye), side_of(light)).v);
}

/// expects: a usable ray; finite corners within the coordinates allowed.
template <class S>
[[nodiscard]] bool may_touch(formula::GnRay<S> const& ray, math::vec3 const& lo, math::vec3 const& hi) noexcept {
    math::vec3 first = lo;
    math::vec3 last = hi;
    int const axis[3] = {ray.axis_x.v, ray.axis_y.v, ray.axis_z.v};
    bool const mirrored[3] = {(ray.sign.x < 0.0F).v, (ray.sign.y < 0.0F).v, (ray.sign.z < 0.0F).v};
    for (int i = 0; i < 3; ++i)
        if (mirrored[i]) std::swap(first[axis[i]], last[axis[i]]);
    return formula::gn_may_touch<S>(ray, formula::gn_in_frame<S>(ray, renamed(ray, first)),
                                    formula::gn_in_frame<S>(ray, renamed(ray, last)))
        .v;
}

/// Whether the triangle is solid where the segment passes it. expects: that it may be met.
template <class S>
[[nodiscard]] Answer filter_solid(AlphaTest const& test, core::TriangleId triangle,
                                  formula::GnMeeting<S> const& meeting) noexcept {
    std::size_t const id = triangle.index();
    if (id >= test.material_of.size() || test.material_of[id] >= test.materials.size()) return Answer::blocked;
    AlphaMaterial const& material = test.materials[test.material_of[id]];
    bool const textured = material.texture < test.textures.size() && math::is_complete(test.textures[material.texture]);
    if (!material.is_masked) return Answer::blocked;
    if (!textured) return static_cast<Answer>(formula::gn_at_least<S>(S(material.factor), S(material.cutoff)).v);
    if (3 * id + 2 >= test.uvs.size()) return Answer::unsure;
    math::vec2 const* const uv = test.uvs.data() + 3 * id;
    math::vec3 const u(uv[0].x, uv[1].x, uv[2].x);
    math::vec3 const v(uv[0].y, uv[1].y, uv[2].y);
    formula::GnShares<S> const shares = formula::gn_shares<S>(meeting);
    bool const legal = in_range(u) && in_range(v) && in_range(math::vec3(material.factor, material.cutoff, 0.0F));
    if (!shares.usable.v || !legal) return Answer::unsure;
    math::AlphaTexture const& texture = test.textures[material.texture];
    auto const tap = [&](math::vec3 const& at, std::int32_t size, math::Wrap wrap) noexcept {
        auto const coordinate = formula::gn_coordinate<S>(shares, S(at.x), S(at.y), S(at.z));
        return formula::gn_tap<S>(coordinate, size, static_cast<std::int32_t>(wrap));
    };
    auto const x = tap(u, texture.size_px.x, texture.wrap_u);
    auto const y = tap(v, texture.size_px.y, texture.wrap_v);
    auto const code = [&](auto const& column, auto const& row) noexcept {
        std::ptrdiff_t const at = std::ptrdiff_t{row.v} * texture.size_px.x + column.v;
        return S(static_cast<float>(texture.texels.data()[(at + 1) * texture.channels - 1]));
    };
    formula::Vec4<S> const codes(code(x.first, y.first), code(x.second, y.first), code(x.first, y.second),
                                 code(x.second, y.second));
    return static_cast<Answer>(formula::gn_solid<S>(codes, x, y, S(material.factor), S(material.cutoff)).v);
}

struct AllSolid {
    template <class S>
    [[nodiscard]] Answer operator()(core::TriangleId, formula::GnMeeting<S> const&) const noexcept {
        return Answer::blocked;
    }
};

struct MaskFilter {
    AlphaTest test;
    template <class S>
    [[nodiscard]] Answer operator()(core::TriangleId id, formula::GnMeeting<S> const& meeting) const noexcept {
        return filter_solid(test, id, meeting);
    }
};

/// All coordinates of the hierarchy are such that the filter may be asked.
[[nodiscard]] inline bool in_range(Node const& root) noexcept {
    bool all = true;
    for (std::size_t i = 0; i < width; ++i) {
        if (root.child[i].is_empty()) continue;
        all = all && in_range(math::vec3(root.lo[0][i], root.lo[1][i], root.lo[2][i])) &&
              in_range(math::vec3(root.hi[0][i], root.hi[1][i], root.hi[2][i]));
    }
    return all;
}

/// The walk that the shader makes, step by step.
template <class S, std::size_t StackSize = filter_stack, class Solidity>
[[nodiscard]] Answer filter_blocked(Bvh const& bvh, Segment const& s, core::TriangleId own,
                                    Solidity const& solidity) noexcept {
    if (bvh.nodes.empty()) return Answer::free;
    formula::GnRay<S> const ray = make_ray<S>(s);
    if (!ray.usable.v || !in_range(bvh.nodes.front())) return Answer::unsure;
    std::array<Child, StackSize> stack;
    std::size_t size = 0;
    stack[size++] = Child::node(0);
    bool unsure = false;
    while (size != 0) {
        Child const at = stack[--size];
        for (std::size_t i = 0; i < width; ++i) {
            if (!at.is_block()) {
                Node const& node = bvh.nodes[at.index()];
                auto const corner = [&](float const(*from)[width]) {
                    return math::vec3(from[0][i], from[1][i], from[2][i]);
                };
                if (node.child[i].is_empty() || !may_touch(ray, corner(node.lo), corner(node.hi))) continue;
                if (size == StackSize)
                    unsure = true;
                else
                    stack[size++] = node.child[i];
                continue;
            }
            Block const& block = bvh.blocks[at.index()];
            if (block.id[i].is_none() || block.id[i] == own) continue;
            formula::GnMeeting<S> const meeting = meet(ray, block.triangle(i));
            if (meeting.answer.v == 0) continue;
            Answer const solid = solidity(block.id[i], meeting);
            if (meeting.answer.v == 1 && solid == Answer::blocked) return Answer::blocked;
            unsure = unsure || solid != Answer::free;
        }
    }
    return unsure ? Answer::unsure : Answer::free;
}

}  // namespace detail

/// `blocks(t, s)`, or unsure.
///
/// expects: finite corners, at most `max_filter_coordinate`.
[[nodiscard]] inline Answer filter_blocks(Triangle const& t, Segment const& s) noexcept {
    auto const ray = detail::make_ray<float>(s);
    return ray.usable.v ? static_cast<Answer>(detail::meet(ray, t).answer.v) : Answer::unsure;
}

/// Whether the plane of `t` has eye and light strictly on opposite sides (`blocked`), or unsure.
///
/// expects: finite corners, at most `max_filter_coordinate`.
[[nodiscard]] inline Answer filter_separates(Triangle const& t, predicates::Target const& eye,
                                             Light const& light) noexcept {
    return detail::filter_separates<float>(t, eye, light);
}

/// `is_blocked(bvh, s, own)`, or unsure.
///
/// expects: `bvh` passes `validate`.
[[nodiscard]] inline Answer filter_blocked(Bvh const& bvh, Segment const& s, core::TriangleId own = {}) noexcept {
    return detail::filter_blocked<float>(bvh, s, own, detail::AllSolid{});
}

/// The same with masked triangles.
[[nodiscard]] inline Answer filter_blocked(Bvh const& bvh, Segment const& s, core::TriangleId own,
                                           AlphaTest const& test) noexcept {
    return detail::filter_blocked<float>(bvh, s, own, detail::MaskFilter{test});
}

}  // namespace gnomon::trace
