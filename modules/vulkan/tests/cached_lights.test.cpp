// Maps of local lights that are kept, on a device: the texels of those that it draws anew.

#include "../../pipeline/tests/cached_light_runs.hpp"
#include "test_host.hpp"

#include <gnomon/vulkan/backend.hpp>

using namespace gnomon;

namespace {

void follow_on_device(test::Course& course, std::size_t frames) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::TestHost host(*device);
    auto const made = vulkan::Backend::make(device->gpu(), host.host());
    REQUIRE(made.has_value());
    test::CourseEnd const seen = test::run(course, **made, frames);
    CHECK(seen.wrong == 0);
    CHECK(seen.quiet_draws == 0);
    CHECK(seen.kept * 2 < seen.plain);
    CHECK(device->take_messages() == "");
}

}  // namespace

TEST_CASE("maps that are kept on the device are those that it draws anew, texel for texel", "[vulkan][cached]") {
    for (pipeline::Light const& light : {test::bulb_among_cubes(), test::spot_among_cubes()}) {
        test::LooseCubes cubes(9);
        test::Course course(cubes, light, {{"resolution", "96"}});
        follow_on_device(course, 24);
    }
}

TEST_CASE("maps that are kept on the device are those that it draws anew, in many frames", "[vulkan][cached][.full]") {
    for (pipeline::Light const& light : {test::bulb_among_cubes(), test::spot_among_cubes(), pipeline::sun(math::dvec3(-0.4, -1.0, -0.3))}) {
        test::LooseCubes cubes(7);
        test::Course course(cubes, light, {{"resolution", "96"}});
        course.changes_light = light.kind != pipeline::LightKind::directional;
        follow_on_device(course, 400);
    }
}
