#pragma once
// Parity: one formula over many inputs on the device and in C++, compared word by word.
//
// A shader takes `in` words an item from buffer 0 and writes `out` words to buffer 1; further buffers hold what all items
// share. The C++ side does the same. Items whose C++ result changes when subnormal numbers are flushed to zero, as a
// device may do, are left out and counted.

#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/kernel.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace gnomon::vulkan::test {

/// Subnormal operands and results are zero while it lives, where the machine can do that.
class FlushToZero {
  public:
#if defined(__SSE2__)
    FlushToZero() noexcept : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040U); }
    ~FlushToZero() { _mm_setcsr(before_); }
    FlushToZero(FlushToZero const&) = delete;
    FlushToZero& operator=(FlushToZero const&) = delete;

  private:
    unsigned before_;
#endif
};

/// Floats that are hard to agree on: any normal bit pattern, neighbours of powers of two, texel borders and middles,
/// huge, tiny, signed zeros, plain coordinates.
class HardFloats {
  public:
    explicit HardFloats(std::uint64_t seed) noexcept : state_(seed * 2 + 1) {}

    std::uint32_t bits() noexcept {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 7U;
        state_ ^= state_ << 17U;
        return static_cast<std::uint32_t>(state_ >> 16U);
    }
    /// In [lo, hi).
    float between(float lo, float hi) noexcept {
        return lo + (hi - lo) * (static_cast<float>(bits() >> 8U) * 0x1p-24F);
    }
    float any_normal() noexcept {
        std::uint32_t const b = bits();
        return std::bit_cast<float>((b & 0x807F'FFFFU) | (1U + (bits() % 254U)) << 23U);
    }
    /// `x` or a float at most two further.
    float beside(float x) noexcept {
        std::uint32_t const b = std::bit_cast<std::uint32_t>(x);
        if ((b & 0x7FFF'FFFFU) < 0x0080'0003U) return x;
        return std::bit_cast<float>(b + bits() % 5U - 2U);
    }
    float any() noexcept {
        switch (bits() % 8U) {
            case 0: return any_normal();
            case 1: return beside(std::bit_cast<float>((bits() & 0x8000'0000U) | (2U + bits() % 250U) << 23U));
            case 2: return beside(static_cast<float>(bits() % 20000U) * 0.5F);
            case 3: return static_cast<float>(static_cast<std::int32_t>(bits() % 4097U) - 2048) * 0.25F;
            case 4: return std::bit_cast<float>(bits() & 0x8000'0000U);
            case 5: return between(-1e30F, 1e30F);
            case 6: return between(-100.0F, 100.0F);
            default: return between(0.0F, 1.0F);
        }
    }

  private:
    std::uint64_t state_;
};

struct ParityKernel {
    std::string_view name;
    std::span<std::uint32_t const> spirv;
    std::size_t in = 0;
    std::size_t out = 0;
};

/// Runs the shader over `inputs` (whole items); `shared` are the buffers behind the first two.
inline std::vector<std::uint32_t> run_on_device(Device& device, ParityKernel const& kernel,
                                                std::span<std::uint32_t const> inputs,
                                                std::span<std::span<std::uint32_t const> const> shared = {}) {
    GpuRef const gpu = device.gpu();
    std::size_t const count = inputs.size() / kernel.in;
    auto const made = ComputeKernel::make(gpu, {.name = kernel.name,
                                                .spirv = kernel.spirv,
                                                .buffers = static_cast<std::uint32_t>(2 + shared.size()),
                                                .targets = 0,
                                                .constant_bytes = 4});
    REQUIRE(made);
    DescriptorRing sets(gpu, 1);
    std::vector<Buffer> buffers;
    buffers.push_back(words_buffer(gpu, inputs.size()));
    buffers.push_back(words_buffer(gpu, count * kernel.out));
    std::copy(inputs.begin(), inputs.end(), words_of(buffers[0]).begin());
    for (auto const words : shared) {
        buffers.push_back(words_buffer(gpu, words.size()));
        std::copy(words.begin(), words.end(), words_of(buffers.back()).begin());
    }
    std::vector<VkDescriptorBufferInfo> infos;
    for (Buffer const& buffer : buffers) infos.push_back(whole(buffer));
    REQUIRE(sets.begin_frame({0, 0}));
    VkCommandBuffer const commands = device.begin();
    auto const n = static_cast<std::uint32_t>(count);
    REQUIRE(made->record(commands, sets, {n, infos, {}, std::as_bytes(std::span(&n, 1))}));
    order_for_host(*gpu, commands);
    device.submit_and_wait();
    auto const results = words_of(buffers[1]);
    return {results.begin(), results.end()};
}

/// What came of one word of the results.
struct Agreement {
    std::uint64_t compared = 0;
    std::uint64_t differing = 0;
    std::uint64_t flushed = 0;  ///< Left out: subnormal numbers took part.
    std::uint64_t worst_ulps = 0;
    std::size_t first = 0;  ///< The item of the first difference.
};

/// Steps between two floats given by their bits; a NaN is no steps from a NaN and 2^32 from anything else.
inline std::uint64_t steps_between(std::uint32_t a, std::uint32_t b) noexcept {
    auto const is_nan = [](std::uint32_t x) { return (x & 0x7FFF'FFFFU) > 0x7F80'0000U; };
    if (is_nan(a) || is_nan(b)) return is_nan(a) && is_nan(b) ? 0 : std::uint64_t{1} << 32U;
    auto const place = [](std::uint32_t x) {
        auto const magnitude = static_cast<std::int64_t>(x & 0x7FFF'FFFFU);
        return (x >> 31U) != 0 ? -magnitude : magnitude;
    };
    std::int64_t const steps = place(a) - place(b);
    return static_cast<std::uint64_t>(steps < 0 ? -steps : steps);
}

/// Calls `host` where no compiler can move its arithmetic out of, or reuse it.
template <class Host>
[[gnu::noinline]] void compute(Host const& host, std::span<std::uint32_t const> item, std::span<std::uint32_t> out) {
    __asm__ volatile("" ::: "memory");
    host(item, out);
    __asm__ volatile("" ::: "memory");
}

/// Compares the device's words with C++'s, `host(item words, out words)`, column by column.
template <class Host>
std::vector<Agreement> compare(ParityKernel const& kernel, std::span<std::uint32_t const> inputs,
                               std::span<std::uint32_t const> device, Host const& host) {
    std::vector<Agreement> columns(kernel.out);
    std::vector<std::uint32_t> plain(kernel.out);
    std::vector<std::uint32_t> flushed(kernel.out);
    for (std::size_t i = 0; i < inputs.size() / kernel.in; ++i) {
        auto const item = inputs.subspan(i * kernel.in, kernel.in);
        compute(host, item, plain);
        {
            FlushToZero const flush;
            compute(host, item, flushed);
        }
        for (std::size_t c = 0; c < kernel.out; ++c) {
            Agreement& column = columns[c];
            if (plain[c] != flushed[c]) {
                ++column.flushed;
                continue;
            }
            ++column.compared;
            std::uint64_t const steps = steps_between(plain[c], device[i * kernel.out + c]);
            bool const both_nan = steps == 0 && (plain[c] & 0x7FFF'FFFFU) > 0x7F80'0000U;
            if (plain[c] == device[i * kernel.out + c] || both_nan) continue;
            if (column.differing++ == 0) column.first = i;
            column.worst_ulps = std::max(column.worst_ulps, steps);
        }
    }
    return columns;
}

}  // namespace gnomon::vulkan::test
