#include "parity.hpp"
#include "pass_scenes.hpp"

#include "shaders/ortho_exact_comp.hpp"

#include <cstdio>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

__extension__ using Wide128 = __int128;

/// A whole number of up to 41 bits, of any size, often with many zeros at its end.
double whole_number(Random& random) {
    std::uint64_t const bits = random.next() >> (23 + random.next() % 41);
    std::uint64_t const cut = bits >> (random.next() % 8 == 0 ? random.next() % 40 : 0);
    auto const magnitude = static_cast<double>(cut);
    return random.next() % 2 == 0 ? magnitude : -magnitude;
}

}  // namespace

TEST_CASE("edge functions and quotients of far triangles are rounded once, as the CPU rounds them", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    constexpr std::size_t count = 200'000;
    Random random{77};
    std::vector<double> numbers(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 4; ++k) numbers[4 * i + k] = whole_number(random);
        if (i % 5 == 0) numbers[4 * i + 2] = numbers[4 * i];  // nearly cancelled
        if (i % 10 == 0) numbers[4 * i + 3] = numbers[4 * i + 1] + static_cast<double>(random.next() % 3);
    }
    std::vector<std::uint32_t> words(8 * count);
    std::memcpy(words.data(), numbers.data(), words.size() * 4);
    auto const out = run_on_device(*device, {"ortho_exact", vulkan::test::ortho_exact_comp, 8, 8}, words);
    std::vector<double> results(4 * count);
    std::memcpy(results.data(), out.data(), out.size() * 4);

    std::uint64_t wrong[3] = {0, 0, 0};
    std::uint64_t own = 0;
    std::uint64_t wide = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double const* const n = &numbers[4 * i];
        auto const whole = [&](std::size_t k) { return Wide128{static_cast<std::int64_t>(n[k])}; };
        Wide128 const cross = whole(0) * whole(1) - whole(2) * whole(3);
        auto const value = static_cast<double>(cross);
        double const by = std::max(value < 0.0 ? -value : value, 1.0);
        wide += by > 0x1p53 ? 1U : 0U;
        wrong[0] += results[4 * i] != value ? 1U : 0U;
        wrong[1] += results[4 * i + 1] != static_cast<double>((cross > 0) - (cross < 0)) ? 1U : 0U;
        wrong[2] += results[4 * i + 2] != n[0] / by ? 1U : 0U;
        own += results[4 * i + 3] != n[0] / by ? 1U : 0U;
    }
    std::printf("ortho arithmetic: %llu of %zu crosses beyond 53 bits; of the device's own quotients %llu differ\n",
                static_cast<unsigned long long>(wide), count, static_cast<unsigned long long>(own));
    CHECK(wrong[0] == 0);
    CHECK(wrong[1] == 0);
    CHECK(wrong[2] == 0);
    CHECK(wide > count / 5);
    CHECK(device->take_messages() == "");
}
