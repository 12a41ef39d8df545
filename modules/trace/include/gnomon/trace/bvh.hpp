#pragma once
// The hierarchy: nodes of up to four boxes, leaves of up to four triangles that hold copies of their coordinates.
//
// Boxes are the exact bounds of float vertices, so nothing is rounded when they are made.

#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/trace/segment.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::trace {

inline constexpr std::size_t width = 4;

/// Deepest tree that `build_bvh` makes; see its cost.
inline constexpr std::size_t max_depth = 96;

/// What a node's slot holds: another node, a block of triangles, or nothing.
struct Child {
    std::uint32_t bits = std::numeric_limits<std::uint32_t>::max();

    static constexpr std::uint32_t block_flag = 1U << 31U;

    [[nodiscard]] static constexpr Child node(std::uint32_t index) noexcept { return {index}; }
    [[nodiscard]] static constexpr Child block(std::uint32_t index) noexcept { return {index | block_flag}; }
    [[nodiscard]] constexpr bool is_empty() const noexcept { return bits == Child{}.bits; }
    [[nodiscard]] constexpr bool is_block() const noexcept { return (bits & block_flag) != 0; }
    [[nodiscard]] constexpr std::uint32_t index() const noexcept { return bits & ~block_flag; }
};

/// Four boxes, axis by axis. An empty slot has lo = +infinity and hi = -infinity: no segment touches it.
struct alignas(64) Node {
    float lo[3][width];
    float hi[3][width];
    Child child[width];
};

/// Up to four triangles, corner by corner and axis by axis. Unused lanes have no id, and repeat lane 0's coordinates.
struct alignas(16) Block {
    float corner[3][3][width];
    core::TriangleId id[width];

    [[nodiscard]] Triangle triangle(std::size_t lane) const noexcept {
        auto const at = [&](int c) noexcept {
            return math::vec3(corner[c][0][lane], corner[c][1][lane], corner[c][2][lane]);
        };
        return {at(0), at(1), at(2)};
    }
};

static_assert(sizeof(Node) == 128 && sizeof(Block) == 160);

/// Triangles that can block nothing, and are not in the hierarchy.
struct LeftOut {
    std::uint64_t bad_index = 0;   ///< An index beyond the positions.
    std::uint64_t not_finite = 0;  ///< A NaN or an infinity in a position.
    std::uint64_t zero_area = 0;   ///< The three positions lie on one line, exactly.

    friend bool operator==(LeftOut const&, LeftOut const&) noexcept = default;
};

/// Made by `build_bvh`. Holds all it needs: the triangle list may go away. Without triangles it has no nodes.
struct Bvh {
    std::vector<Node> nodes;  ///< The root is the first.
    std::vector<Block> blocks;
    std::size_t triangles = 0;  ///< In the hierarchy.
    LeftOut left_out;
};

/// What a query walks: a `Bvh`, or the same nodes and blocks in somebody's buffers.
struct BvhView {
    std::span<Node const> nodes;
    std::span<Block const> blocks;

    BvhView() = default;
    BvhView(std::span<Node const> n, std::span<Block const> b) noexcept : nodes(n), blocks(b) {}
    BvhView(Bvh const& bvh) noexcept : nodes(bvh.nodes), blocks(bvh.blocks) {}  // NOLINT: converts as spans do
};

}  // namespace gnomon::trace
