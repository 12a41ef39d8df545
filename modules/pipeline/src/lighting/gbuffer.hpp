#pragma once
// The G-buffer: what shading reads of a sample but its position, as [Olsson 2014, Paper I, 8] has it: four targets of four
// numbers, 16 or 32 bits each.

#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/frame.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::pipeline {

enum class GBufferFormat : std::uint8_t {
    f16,  ///< 32 bytes a sample.
    f32,  ///< 64 bytes a sample.
};

/// Numbers of a sample, in this order; each row is a target.
struct GBufferTexel {
    float normal[3];
    float unused_a;
    float diffuse[3];
    float unused_b;
    float specular[3];  ///< Times the highlight's scale, see lights::highlight_scale.
    float shininess;    ///< The exponent is 2^shininess.
    float emissive[3];  ///< And ambient: what no light adds.
    float unused_c;
};
static_assert(sizeof(GBufferTexel) == 64);

/// 32-bit words of a sample.
[[nodiscard]] constexpr std::size_t words_of(GBufferFormat format) noexcept { return format == GBufferFormat::f32 ? 16 : 8; }

/// Texels of all samples, one after the other; halves two to a word, the first in the lower bits.
[[nodiscard]] std::vector<std::uint32_t> make_gbuffer(Frame const& frame, GBufferFormat format, core::ExecutorRef executor);

}  // namespace gnomon::pipeline
