// Light lists on the device: the host's, bit for bit.

#include "../../pipeline/tests/device_lists.hpp"
#include "test_host.hpp"

#include <gnomon/check/check.hpp>

using namespace gnomon;

namespace {

void check_scenes_on_device(math::ivec2 size_px, std::size_t scattered, std::int32_t tile_px) {
    vulkan::test::DeviceBackend on;
    for (test::DeviceScene const& scene : test::device_scenes) {
        CAPTURE(scene.name);
        test::DeviceFrame const frame(scene, size_px, scattered);
        test::check_device_lists(frame, *on.gpu, tile_px, scene.normal_n);
    }
    test::check_device_lists({test::device_scenes[0], size_px + math::ivec2(1), scattered, test::DeviceView::off_centre}, *on.gpu, tile_px, 3);
    test::check_device_lists({test::far_scene, size_px, scattered}, *on.gpu, tile_px, 0);
    test::DeviceFrame frame(test::device_scenes[0], size_px, scattered, test::DeviceView::orthographic);
    test::check_device_lists(frame, *on.gpu, tile_px, 0);
    frame.lights.clear();
    test::check_device_lists(frame, *on.gpu, tile_px, 0);
    frame.lights.assign(1500, pipeline::bulb(math::dvec3(0.0)));
    test::check_device_lists(frame, *on.gpu, 4 * tile_px, 0);
    CHECK(on.device->take_messages() == "");
}

}  // namespace

TEST_CASE("keys, clusters, bounds, light tree and light lists of a device are the host's, in six scenes", "[vulkan][lighting]") {
    check_scenes_on_device({96, 54}, 200, 16);
}
TEST_CASE("keys, clusters, bounds, light tree and light lists of a device are the host's, of 640 x 360 pixels and 5,000 lights",
          "[vulkan][lighting][.full]") {
    check_scenes_on_device({640, 360}, 5000, 16);
}

TEST_CASE("scans and sorts by kernels are a loop's on the device, for any size", "[vulkan][lighting]") {
    vulkan::test::DeviceBackend on;
    std::uint32_t const sizes[] = {1, 2, 63, 64, 1023, 1024, 1025, 20'000, 1'100'000};
    test::check_scan_and_sort(*on.gpu, sizes);
    CHECK(on.device->take_messages() == "");
}
