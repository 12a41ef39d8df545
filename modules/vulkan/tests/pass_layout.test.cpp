#include "../src/ortho_layout.hpp"
#include "../src/pass_layout.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include "shaders/ortho_layout_comp.hpp"
#include "shaders/pass_layout_comp.hpp"

#include <cstddef>

using namespace gnomon;
using namespace gnomon::vulkan::detail;

namespace {

using Members = std::vector<vulkan::ShaderMember>;

#define GNOMON_MEMBER(Struct, name) \
    { #name, static_cast<std::uint32_t>(offsetof(Struct, name)), static_cast<std::uint32_t>(sizeof(Struct::name)) }

}  // namespace

TEST_CASE("the passes' structs lie in GLSL as they do in C++", "[vulkan][pass]") {
    auto const words = vulkan::test::pass_layout_comp;
    REQUIRE(vulkan::reflect(words, "pass_layout.comp"));
    CHECK(vulkan::members_of(words, "View") == Members{GNOMON_MEMBER(ViewData, column), GNOMON_MEMBER(ViewData, origin),
                                                       GNOMON_MEMBER(ViewData, layer), GNOMON_MEMBER(ViewData, groups),
                                                       GNOMON_MEMBER(ViewData, unused)});
    CHECK(vulkan::members_of(words, "Item") ==
          Members{GNOMON_MEMBER(ItemData, first_triangle), GNOMON_MEMBER(ItemData, matrix), GNOMON_MEMBER(ItemData, alpha),
                  GNOMON_MEMBER(ItemData, uv_shift), GNOMON_MEMBER(ItemData, groups), GNOMON_MEMBER(ItemData, first_index),
                  GNOMON_MEMBER(ItemData, first_position)});
    CHECK(vulkan::members_of(words, "Push") ==
          Members{GNOMON_MEMBER(PassPush, first_view), GNOMON_MEMBER(PassPush, layers), GNOMON_MEMBER(PassPush, matrix_views),
                  GNOMON_MEMBER(PassPush, instanced), GNOMON_MEMBER(PassPush, bias_constant),
                  GNOMON_MEMBER(PassPush, bias_slope), GNOMON_MEMBER(PassPush, viewport_px),
                  GNOMON_MEMBER(PassPush, viewport_size_px)});
    CHECK(vulkan::members_of(words, "AlphaTest") ==
          Members{GNOMON_MEMBER(AlphaData, first_texel), GNOMON_MEMBER(AlphaData, width), GNOMON_MEMBER(AlphaData, height),
                  GNOMON_MEMBER(AlphaData, wrap_u), GNOMON_MEMBER(AlphaData, wrap_v), GNOMON_MEMBER(AlphaData, least),
                  GNOMON_MEMBER(AlphaData, least_exact)});
}

TEST_CASE("the integer passes' structs lie in GLSL as they do in C++", "[vulkan][ortho]") {
    auto const words = vulkan::test::ortho_layout_comp;
    REQUIRE(vulkan::reflect(words, "ortho_layout.comp"));
    auto const light = vulkan::members_of(words, "Light");
    REQUIRE(light.size() == 6);
    CHECK(light[0].offset == offsetof(LightData, axes));
    CHECK(light[2].offset == offsetof(LightData, axes) + 2 * sizeof(LightData::axes[0]));
    CHECK(light[3].offset == offsetof(LightData, origin_m));
    CHECK(light[4].offset == offsetof(LightData, image));
    CHECK(light[5].offset == offsetof(LightData, unused));
    CHECK(light[5].offset + light[5].bytes == sizeof(LightData));
    CHECK(vulkan::members_of(words, "Push") ==
          Members{GNOMON_MEMBER(OrthoPush, area_px), GNOMON_MEMBER(OrthoPush, centre_px), GNOMON_MEMBER(OrthoPush, per_unit),
                  GNOMON_MEMBER(OrthoPush, per_code), GNOMON_MEMBER(OrthoPush, most_units), GNOMON_MEMBER(OrthoPush, most_size),
                  GNOMON_MEMBER(OrthoPush, light), GNOMON_MEMBER(OrthoPush, cull), GNOMON_MEMBER(OrthoPush, flags)});
}
