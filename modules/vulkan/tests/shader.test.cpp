#include "test_device.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/shader.hpp>

#include "shaders/add_comp.hpp"

#include <algorithm>
#include <cstdio>

using namespace gnomon;

namespace {

std::size_t count_of(std::vector<std::uint32_t> const& words, std::uint32_t wanted, std::uint32_t decoration = 0) {
    std::size_t count = 0;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16U)
        if ((words[at] & 0xFFFFU) == wanted && (decoration == 0 || words[at + 2] == decoration)) ++count;
    return count;
}

}  // namespace

TEST_CASE("every product and sum of a shader is marked against contraction", "[vulkan][shader]") {
    constexpr std::uint32_t decorate = 71;
    constexpr std::uint32_t no_contraction = 42;
    std::vector<std::uint32_t> const before(vulkan::test::add_comp.begin(), vulkan::test::add_comp.end());
    REQUIRE(!before.empty());
    CHECK(count_of(before, decorate, no_contraction) == 0);
    std::vector<std::uint32_t> const after = vulkan::without_contraction(before);
    CHECK(count_of(after, decorate, no_contraction) == count_of(before, 133) + count_of(before, 129));
    CHECK(count_of(after, decorate, no_contraction) == 2);
    CHECK(vulkan::without_contraction(after) == after);
}

TEST_CASE("a shader asks for the float controls that it is told to, and a device takes all that it has", "[vulkan][shader]") {
    constexpr std::uint32_t capability = 17;
    constexpr std::uint32_t execution_mode = 16;
    std::vector<std::uint32_t> const before(vulkan::test::add_comp.begin(), vulkan::test::add_comp.end());
    CHECK(vulkan::with_float_controls(before, {}) == before);
    auto const after = vulkan::with_float_controls(before, {.nan_and_zero_signs = true, .denormals = true, .round_to_nearest = true});
    CHECK(count_of(after, capability) == count_of(before, capability) + 3);
    CHECK(count_of(after, 10) == count_of(before, 10) + 1);
    CHECK(count_of(after, execution_mode) == count_of(before, execution_mode) + 3);
    for (std::uint32_t const mode : {4459U, 4461U, 4462U}) CHECK(count_of(after, execution_mode, mode) == 1);

    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    auto const has = vulkan::float_controls_of(device->gpu()->properties);
    std::printf("float controls: NaN and signs of zero %d, subnormals %d, rounding to nearest %d\n", has.nan_and_zero_signs,
                has.denormals, has.round_to_nearest);
    CHECK(vulkan::make_shader(device->gpu(), vulkan::test::add_comp, "add"));
    CHECK(device->take_messages() == "");
}

TEST_CASE("what is no SPIR-V is refused, not crashed on", "[vulkan][shader]") {
    std::vector<std::uint32_t> const noise{0x07230203U, 0x10000U, 0U, 5U, 0U, 0xFFFF0047U};
    CHECK(vulkan::without_contraction(noise) == noise);
    CHECK(vulkan::with_float_controls(noise, {.nan_and_zero_signs = true}) == noise);
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    auto const none = vulkan::make_shader(device->gpu(), {}, "nothing");
    REQUIRE(!none);
    CHECK(none.failure().code == vulkan::Error::shader_rejected);
    CHECK(vulkan::make_shader(device->gpu(), vulkan::test::add_comp, "add"));
    CHECK(device->take_messages() == "");
}
