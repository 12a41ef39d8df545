// The kernels that scan and sort: their C++ halves.

#include <shaders/scan_apply_comp.hpp>
#include <shaders/scan_sums_comp.hpp>
#include <shaders/sort_count_comp.hpp>
#include <shaders/sort_scatter_comp.hpp>

#include "device_kernels.hpp"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr std::size_t tile_grain = 16 * backend::kernel_local_size;

constexpr std::uint32_t capped_sum(std::uint32_t a, std::uint32_t b) noexcept { return a + b < a ? ~0U : a + b; }

/// The numbers of a tile.
struct Tile {
    std::size_t begin, end;
    Tile(std::size_t tile, std::size_t count) noexcept
        : begin(std::min(tile * tile_numbers, count)), end(std::min(begin + tile_numbers, count)) {}
};

void sum_tiles(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    std::size_t const count = data.constant<std::uint32_t>();
    auto const values = data.buffer<std::uint32_t const>(0);
    auto const sums = data.buffer<std::uint32_t>(1);
    for_each_group(begin, end, [&](std::size_t tile) {
        Tile const t(tile, count);
        std::uint32_t sum = 0;
        for (std::size_t i = t.begin; i < t.end; ++i) sum = capped_sum(sum, values[i]);
        sums[tile] = sum;
    });
}

void scan_tiles(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ScanStd>();
    auto const values = data.buffer<std::uint32_t>(0);
    auto const bases = data.buffer<std::uint32_t const>(1);
    for_each_group(begin, end, [&](std::size_t tile) {
        Tile const t(tile, c.count);
        std::uint32_t running = c.has_bases != 0 ? bases[tile] : 0;
        for (std::size_t i = t.begin; i < t.end; ++i) {
            std::uint32_t const value = values[i];
            values[i] = running;
            running = capped_sum(running, value);
        }
    });
}

struct Pair {
    std::uint32_t key;
    std::uint32_t value;
};

void count_digits(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<SortStd>();
    auto const pairs = data.buffer<Pair const>(0);
    auto const counts = data.buffer<std::uint32_t>(1);
    std::size_t const tiles = (c.count + tile_numbers - 1) / tile_numbers;
    for_each_group(begin, end, [&](std::size_t tile) {
        std::uint32_t of_digit[sort_digits] = {};
        Tile const t(tile, c.count);
        for (std::size_t i = t.begin; i < t.end; ++i) ++of_digit[pairs[i].key >> c.shift & (sort_digits - 1)];
        for (std::size_t d = 0; d < sort_digits; ++d) counts[d * tiles + tile] = of_digit[d];
    });
}

void scatter_digits(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<SortStd>();
    auto const pairs = data.buffer<Pair const>(0);
    auto const places = data.buffer<std::uint32_t const>(1);
    auto const moved = data.buffer<Pair>(2);
    std::size_t const tiles = (c.count + tile_numbers - 1) / tile_numbers;
    for_each_group(begin, end, [&](std::size_t tile) {
        std::uint32_t next[sort_digits];
        for (std::size_t d = 0; d < sort_digits; ++d) next[d] = places[d * tiles + tile];
        Tile const t(tile, c.count);
        for (std::size_t i = t.begin; i < t.end; ++i) moved[next[pairs[i].key >> c.shift & (sort_digits - 1)]++] = pairs[i];
    });
}

}  // namespace

constinit backend::Kernel const scan_sums_kernel{
    .name = "scan_sums", .cpu = &sum_tiles, .spirv = scan_sums_comp, .buffers = 2, .constant_bytes = 4, .grain = tile_grain};
constinit backend::Kernel const scan_apply_kernel{
    .name = "scan_apply", .cpu = &scan_tiles, .spirv = scan_apply_comp, .buffers = 2, .constant_bytes = sizeof(ScanStd), .grain = tile_grain};
constinit backend::Kernel const sort_count_kernel{
    .name = "sort_count", .cpu = &count_digits, .spirv = sort_count_comp, .buffers = 2, .constant_bytes = sizeof(SortStd), .grain = tile_grain};
constinit backend::Kernel const sort_scatter_kernel{.name = "sort_scatter",
                                                    .cpu = &scatter_digits,
                                                    .spirv = sort_scatter_comp,
                                                    .buffers = 3,
                                                    .constant_bytes = sizeof(SortStd),
                                                    .grain = tile_grain};

}  // namespace gnomon::pipeline
