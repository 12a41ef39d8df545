#pragma once
// What the vector kernels' inner loops are compiled for.

#include "kernel.hpp"

namespace gnomon::raster::detail {

namespace {

/// `Clamp`: depths may be below 0 or beyond 1 (`DepthRange::clamp`).
template <bool Reversed, bool Quantize, bool Ids, bool Clamp>
struct Mode {
    static constexpr bool reversed = Reversed;
    static constexpr bool quantize = Quantize;
    static constexpr bool ids = Ids;
    static constexpr bool clamp = Clamp;
};

}  // namespace

}  // namespace gnomon::raster::detail
