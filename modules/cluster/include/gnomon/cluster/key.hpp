#pragma once
// Cluster keys: where a sample is, and optionally which way it faces, in one number.
//
// 32 bits: row, column, slice, normal cell in 8, 8, 10, 6 bits. 64 bits: 16 of each. Tiles are the high bits: sorted
// keys run tile by tile, as the dense numbers of a layout do.
//
// source: [Olsson 2014, Paper II, 3.1, 4.1]

#include <gnomon/math/text.hpp>
#include <gnomon/cluster/formula/key.glsl>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/result.hpp>

#include <concepts>
#include <cstdint>
#include <string>

namespace gnomon::cluster {

template <class K>
concept Key = std::same_as<K, std::uint32_t> || std::same_as<K, std::uint64_t>;

/// The key of a sample without geometry; no layout has a cluster of this key.
template <Key K>
inline constexpr K no_key = static_cast<K>(~K{0});

/// The index of a sample that is in no cluster.
inline constexpr std::uint32_t no_cluster = 0xFFFFFFFFU;

struct KeyParts {
    std::uint32_t column = 0;
    std::uint32_t row = 0;
    std::uint32_t slice = 0;
    std::uint32_t cell = 0;  ///< Of the normal; 0 without.

    friend constexpr bool operator==(KeyParts const&, KeyParts const&) noexcept = default;
};

/// Field widths of a key, in bits.
template <Key K>
struct KeyBits {
    static constexpr std::uint32_t tile = sizeof(K) == 4 ? 8 : 16;  ///< Of row and of column.
    static constexpr std::uint32_t slice = sizeof(K) == 4 ? 10 : 16;
    static constexpr std::uint32_t cell = sizeof(K) == 4 ? 6 : 16;
};

/// expects: parts that fit their fields, as those of a checked layout do.
template <Key K>
[[nodiscard]] constexpr K pack_key(KeyParts const& p) noexcept {
    using B = KeyBits<K>;
    GNOMON_EXPECT(p.row >> B::tile == 0 && p.column >> B::tile == 0 && p.slice >> B::slice == 0 && p.cell >> B::cell == 0);
    return static_cast<K>(((K{p.row} << B::tile | p.column) << B::slice | p.slice) << B::cell | p.cell);
}

template <Key K>
[[nodiscard]] constexpr KeyParts unpack_key(K key) noexcept {
    using B = KeyBits<K>;
    auto const field = [](K bits, std::uint32_t width) { return static_cast<std::uint32_t>(bits & ((K{1} << width) - 1)); };
    return {field(key >> (B::slice + B::cell), B::tile), field(key >> (B::tile + B::slice + B::cell), B::tile),
            field(key >> B::cell, B::slice), field(key, B::cell)};
}

enum class KeyError : std::uint8_t {
    too_many_tiles,    ///< Columns or rows do not fit 8 (16) bits: larger tiles, or the wide key.
    too_many_slices,   ///< Slices do not fit 10 (16) bits: fewer, or the wide key.
    too_many_normals,  ///< More than 3 (104) parts a side of a cube face: fewer, or the wide key.
};

/// Which keys there are, and their dense numbers, ascending with the keys. Made by `make_key_layout`.
template <Key K>
struct KeyLayout {
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    std::uint32_t slices = 1;
    std::uint32_t cells = 1;     ///< 6 n^2, or 1 without normals.
    std::uint32_t normal_n = 0;  ///< Parts a side of a cube face; 0 without normals.

    /// How many keys there are.
    [[nodiscard]] constexpr std::uint64_t domain() const noexcept {
        return std::uint64_t{rows} * columns * slices * cells;
    }
    [[nodiscard]] constexpr bool holds(KeyParts const& p) const noexcept {
        return p.column < columns && p.row < rows && p.slice < slices && p.cell < cells;
    }
    /// The number of a key among all in ascending order.
    ///
    /// expects: the layout holds its parts
    [[nodiscard]] constexpr std::uint64_t number(KeyParts const& p) const noexcept {
        return ((std::uint64_t{p.row} * columns + p.column) * slices + p.slice) * cells + p.cell;
    }
    /// The key of a number below `domain()`.
    [[nodiscard]] constexpr K key(std::uint64_t number) const noexcept {
        std::uint64_t const depth = number / cells;
        std::uint64_t const tile = depth / slices;
        return pack_key<K>({static_cast<std::uint32_t>(tile % columns), static_cast<std::uint32_t>(tile / columns),
                            static_cast<std::uint32_t>(depth % slices), static_cast<std::uint32_t>(number % cells)});
    }
};

/// The layout of a grid's keys, with `normal_n` x `normal_n` parts on each face of a cube of normals, or 0 for none.
///
/// source: [Olsson 2014, Paper II, 4.1]: 8 + 8 + 10 + 6 bits, up to 3 x 3 parts a face
template <Key K>
[[nodiscard]] core::Result<KeyLayout<K>, KeyError> make_key_layout(GridView const& grid, std::uint32_t normal_n = 0) {
    using B = KeyBits<K>;
    auto const failure = [](KeyError code, std::uint32_t n, char const* what, std::uint32_t most) {
        return core::Failure{code, core::sentence({std::to_string(n), what, std::to_string(most), " in a key of ",
                                                     std::to_string(8 * sizeof(K)), " bits"})};
    };
    std::uint32_t const tiles = grid.columns() > grid.rows() ? grid.columns() : grid.rows();
    if (tiles > 1U << B::tile) return failure(KeyError::too_many_tiles, tiles, " tiles a side: at most ", 1U << B::tile);
    if (grid.slices() > 1U << B::slice)
        return failure(KeyError::too_many_slices, grid.slices(), " slices: at most ", 1U << B::slice);
    std::uint32_t const most = sizeof(K) == 4 ? 3 : 104;
    if (normal_n > most)
        return failure(KeyError::too_many_normals, normal_n, " parts a side of a cube face: at most ", most);
    return KeyLayout<K>{grid.columns(), grid.rows(), grid.slices(), normal_n == 0 ? 1U : 6 * normal_n * normal_n, normal_n};
}

/// The key of a pixel's sample.
///
/// expects: a layout of this grid, a pixel of its image. Any depth and normal is legal; the normal is not read where
///          the layout has none.
template <Key K>
[[nodiscard]] K key_at(Grid const& grid, KeyLayout<K> const& layout, math::uvec2 const& pixel, float depth_m,
                       math::vec3 const& normal = math::vec3(0.0F)) noexcept {
    ClusterCoordinates const c = coordinates_at(grid, pixel, depth_m);
    return pack_key<K>({c.column, c.row, c.slice, layout.normal_n == 0 ? 0U : normal_cell(normal, layout.normal_n)});
}

}  // namespace gnomon::cluster
