#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include "shaders/add_comp.hpp"
#include "shaders/affine_comp.hpp"
#include "shaders/texels_comp.hpp"
#include "shaders/wide_comp.hpp"

using namespace gnomon;

TEST_CASE("a shader's group size, bindings and constants are those of its source", "[vulkan][spirv]") {
    auto const affine = vulkan::reflect(vulkan::test::affine_comp, "affine");
    REQUIRE(affine);
    CHECK(affine->local_size == std::array<std::uint32_t, 3>{64, 1, 1});
    CHECK(affine->constant_bytes == 12);
    CHECK(affine->reads_group_count);
    REQUIRE(affine->bindings.size() == 2);
    CHECK(affine->bindings[1].binding == 1);
    CHECK(affine->bindings[1].type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    CHECK(affine->bindings[0].read_only);
    CHECK_FALSE(affine->bindings[1].read_only);
    CHECK_FALSE(vulkan::reflect(vulkan::test::add_comp, "add")->reads_group_count);
    auto const texels = vulkan::reflect(vulkan::test::texels_comp, "texels");
    REQUIRE(texels);
    CHECK(texels->constant_bytes == 12);
    CHECK(texels->bindings.back().type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    CHECK(vulkan::reflect(vulkan::test::wide_comp, "wide")->local_size == std::array<std::uint32_t, 3>{8, 8, 1});
}

TEST_CASE("members of a struct stand where std430 puts them", "[vulkan][spirv]") {
    using Member = vulkan::ShaderMember;
    CHECK(vulkan::members_of(vulkan::test::affine_comp, "Affine") ==
          std::vector<Member>{{"count", 0, 4}, {"scale", 4, 4}, {"bias", 8, 4}});
    CHECK(vulkan::members_of(vulkan::test::texels_comp, "Item") ==
          std::vector<Member>{{"a", 0, 12}, {"b", 12, 4}, {"m", 16, 64}, {"list", 80, 12}});
    CHECK(vulkan::members_of(vulkan::test::affine_comp, "Outputs") == std::vector<Member>{{"value", 0, 0}});
    CHECK(vulkan::members_of(vulkan::test::affine_comp, "Nobody").empty());
}

TEST_CASE("words that are no SPIR-V, or cut off anywhere, are refused or read without harm", "[vulkan][spirv]") {
    CHECK(vulkan::reflect({}, "none").failure().code == vulkan::Error::shader_rejected);
    std::vector<std::uint32_t> const whole(vulkan::test::texels_comp.begin(), vulkan::test::texels_comp.end());
    std::size_t accepted = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        std::span<std::uint32_t const> const part(whole.data(), n);
        if (vulkan::reflect(part, "cut")) ++accepted;
        (void)vulkan::members_of(part, "Item");
    }
    CHECK(accepted < whole.size() / 2);  // a cut between two instructions is not seen
    check::for_all(check::cases(300), check::integers<std::size_t>(5, whole.size() - 1),
                   check::integers<std::uint32_t>(0, ~0U), [&](std::size_t at, std::uint32_t word) {
                       std::vector<std::uint32_t> broken = whole;
                       broken[at] = word;
                       (void)vulkan::reflect(broken, "broken");
                       (void)vulkan::members_of(broken, "Item");
                   });
}
