// Light lists by the C++ halves of the device's kernels: the host's own, bit for bit.

#include "device_lists.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster/cpu_backend.hpp>

#include <string>

using namespace gnomon;

TEST_CASE("keys, clusters, bounds, light tree and light lists of the kernels are the host's, in six scenes", "[pipeline][lighting]") {
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    for (test::DeviceScene const& scene : test::device_scenes) {
        CAPTURE(scene.name);
        test::DeviceFrame const frame(scene, {96, 54}, 300);
        test::check_device_lists(frame, cpu, 8, scene.normal_n);
    }
}

TEST_CASE("kernels of light lists take windows off the centre, images that are no multiple of the tile, and scenes 1e7 m away", "[pipeline][lighting]") {
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    test::check_device_lists({test::device_scenes[0], {97, 55}, 300, test::DeviceView::off_centre}, cpu, 13, 3);
    test::check_device_lists({test::far_scene, {97, 55}, 300}, cpu, 16, 0);
}

TEST_CASE("kernels of light lists take orthographic views, no lights, one light and 1,500 that are everywhere", "[pipeline][lighting]") {
    core::ThreadExecutor threads(3);
    raster::CpuBackend cpu(threads);
    test::DeviceFrame frame(test::device_scenes[0], {80, 45}, 200, test::DeviceView::orthographic);
    test::check_device_lists(frame, cpu, 16, 0);
    frame.lights.resize(1);
    test::check_device_lists(frame, cpu, 16, 0);
    frame.lights.clear();
    test::check_device_lists(frame, cpu, 16, 0);
    frame.lights.assign(1500, pipeline::bulb(math::dvec3(0.0)));
    test::check_device_lists(frame, cpu, 32, 0);
}

TEST_CASE("scans and sorts by kernels are a loop's, for any size and threads", "[pipeline][lighting]") {
    core::ThreadExecutor threads(3);
    raster::CpuBackend cpu(threads);
    std::uint32_t const sizes[] = {1, 2, 63, 64, 1023, 1024, 1025, 20'000, 300'001, 1'100'000};
    test::check_scan_and_sort(cpu, sizes);
}
