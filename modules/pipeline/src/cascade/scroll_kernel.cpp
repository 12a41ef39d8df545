// The depth kernel that scrolls a map, its C++ half: a row of the formula's texels.

#include "cascade_shadows.hpp"

#include <gnomon/cascade/scroll.hpp>
#include <shaders/scroll_depth_frag.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace gnomon::pipeline {

namespace {

template <class Texel>
void scroll_texels(backend::TexelView const& from, formula::GnScroll const& move, backend::DepthRow const& row) {
    std::span<Texel> const to = row.depths<Texel>();
    Texel const clear = static_cast<Texel>(move.reversed != 0 ? 0.0F : move.last);
    std::int32_t const y = row.y + move.dy;
    std::int32_t const size = from.size_px.x;
    // New pixels [begin, end) show old ones.
    std::int32_t const begin = std::clamp(-move.dx - row.x, 0, row.width);
    std::int32_t const end = std::clamp(size - move.dx - row.x, begin, row.width);
    if (y < 0 || y >= from.size_px.y) {
        std::fill(to.begin(), to.end(), clear);
        return;
    }
    std::fill(to.begin(), to.begin() + begin, clear);
    std::fill(to.begin() + end, to.end(), clear);
    Texel const* const old = from.layer<Texel>(0) + std::ptrdiff_t{y} * size + row.x + move.dx;
    if (move.add == 0.0F) {
        std::copy(old + begin, old + end, to.begin() + begin);
        return;
    }
    bool const reversed = move.reversed != 0;
    auto const moved = [&](Texel held) {
        if constexpr (sizeof(Texel) == 2)
            return gn_scrolled_code(formula::Int<float>(std::int32_t{held}), static_cast<std::int32_t>(move.add),
                                    static_cast<std::int32_t>(move.last), reversed).v;
        else
            return gn_scrolled(formula::Float<float>(held), move.add, move.last, reversed).v;
    };
    for (std::int32_t x = begin; x < end; ++x) to[static_cast<std::size_t>(x)] = static_cast<Texel>(moved(old[x]));
}

void scroll_row(backend::KernelData const& data, backend::DepthRow const& row) {
    auto const move = data.constant<formula::GnScroll>();
    if (row.format == backend::DepthFormat::unorm16) scroll_texels<std::uint16_t>(data.targets[0], move, row);
    else scroll_texels<float>(data.targets[0], move, row);
}

}  // namespace

constinit backend::DepthKernel const scroll_depth_kernel{.name = "scroll_depth",
                                                         .cpu = &scroll_row,
                                                         .spirv = scroll_depth_frag,
                                                         .targets = 1,
                                                         .constant_bytes = sizeof(formula::GnScroll)};

}  // namespace gnomon::pipeline
