#pragma once
// An accessor, checked: after this every element can be read.

#include "gltf_document.hpp"

#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene::detail {

struct Accessor {
    std::byte const* data = nullptr;  ///< Null: all zeros.
    std::size_t stride = 0;
    std::size_t count = 0;
    int components = 0;      ///< 1 for SCALAR to 4 for VEC4, 16 for MAT4.
    int component_type = 0;  ///< As in the file: 5120 to 5126.
    bool normalized = false;
    std::vector<std::uint32_t> sparse_indices;  ///< Ascending.
    std::byte const* sparse_values = nullptr;
    std::size_t element_bytes = 0;

    /// Component `c` of element `i`, as a float as glTF converts it.
    [[nodiscard]] float at(std::size_t i, int c) const noexcept;

    /// Component `c` of element `i`, as the unsigned number it is.
    ///
    /// expects: the component type is one of the unsigned ones.
    [[nodiscard]] std::uint32_t whole_at(std::size_t i, int c) const noexcept;

    [[nodiscard]] std::uint32_t index_at(std::size_t i) const noexcept { return whole_at(i, 0); }

private:
    [[nodiscard]] std::byte const* element(std::size_t i) const noexcept;
};

/// Fails with the accessor's number where its type, offset, stride, count or sparse part do not hold.
Accessor make_accessor(Document& document, int index);

}  // namespace gnomon::scene::detail
