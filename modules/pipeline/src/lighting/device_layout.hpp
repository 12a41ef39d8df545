#pragma once
// Which keys a grid has on a device: packed into 8 + 8 + 10 + 6 bits where they fit, else their dense numbers.

#include <gnomon/cluster/key.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/pipeline/error.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace gnomon::pipeline {

/// Keys and numbers ascend together, either way.
struct DeviceLayout {
    cluster::KeyLayout<std::uint32_t> counts;
    bool packed = true;

    [[nodiscard]] std::uint64_t domain() const noexcept { return counts.domain(); }
    [[nodiscard]] bool holds(std::uint32_t key) const noexcept {
        return packed ? counts.holds(cluster::unpack_key(key)) : key < counts.domain();
    }
    /// expects: `holds(key)`; fewer than 2^32 - 1 keys.
    [[nodiscard]] std::uint32_t number(std::uint32_t key) const noexcept {
        return packed ? static_cast<std::uint32_t>(counts.number(cluster::unpack_key(key))) : key;
    }
    [[nodiscard]] std::uint32_t key(std::uint32_t number) const noexcept { return packed ? counts.key(number) : number; }
    [[nodiscard]] std::uint32_t key(cluster::KeyParts const& parts) const noexcept {
        return packed ? cluster::pack_key<std::uint32_t>(parts) : static_cast<std::uint32_t>(counts.number(parts));
    }
    [[nodiscard]] cluster::KeyParts parts(std::uint32_t key) const noexcept {
        if (packed) return cluster::unpack_key(key);
        std::uint32_t const depth = key / counts.cells;
        std::uint32_t const tile = depth / counts.slices;
        return {tile % counts.columns, tile / counts.columns, depth % counts.slices, key % counts.cells};
    }
};

/// returns: a failure where 64 bits would not hold the keys either, or 32 bits not number them.
[[nodiscard]] inline Result<DeviceLayout> make_device_layout(cluster::GridView const& grid, std::uint32_t normal_n = 0) {
    auto narrow = cluster::make_key_layout<std::uint32_t>(grid, normal_n);
    DeviceLayout layout;
    layout.packed = narrow.has_value();
    if (narrow) {
        layout.counts = std::move(narrow).value();
    } else {
        auto const wide = cluster::make_key_layout<std::uint64_t>(grid, normal_n);
        if (!wide) return core::Failure{Error::bad_value, wide.failure().message};
        layout.counts = {wide->columns, wide->rows, wide->slices, wide->cells, wide->normal_n};
    }
    if (layout.domain() < 0xFFFFFFFFU) return layout;
    return core::Failure{Error::too_large, std::to_string(layout.domain()) + " cluster keys; a device takes fewer than 2^32 - 1: larger tiles"};
}

}  // namespace gnomon::pipeline
