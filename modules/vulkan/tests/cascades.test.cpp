// Cascades on a device: integer passes, scrolling and lookup together.

#include "../../pipeline/tests/cascade_runs.hpp"
#include "test_host.hpp"

#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

using namespace gnomon;

namespace {

/// Maps and visibilities of `csm-scroll` on the device, beside the CPU's `csm`: what is kept there, nothing kept here.
void fly_on_device(std::string const& path, double moving, std::size_t first, std::size_t end, std::vector<pipeline::Setting> const& settings) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::TestHost host(*device);
    auto const made = vulkan::Backend::make(device->gpu(), host.host());
    REQUIRE(made.has_value());
    {
        core::SerialExecutor executor;
        raster::CpuBackend cpu(executor);
        test::Town town(path, moving);
        test::CascadeRunner csm(cpu, "csm", settings), scroll(**made, "csm-scroll", settings);
        std::uint64_t other_texels = 0, other_visibility = 0, samples = 0, scrolls = 0;
        for (std::size_t i = first; i < end; ++i) {
            pipeline::Frame const frame = town.frame(i);
            auto const wanted = csm(frame), got = scroll(frame);
            for (std::size_t t = 0; t < csm.device.codes.size(); ++t) other_texels += csm.device.codes[t] != scroll.device.codes[t] ? 1U : 0U;
            for (std::size_t s = 0; s < wanted.visibility.size(); ++s) other_visibility += wanted.visibility[s] != got.visibility[s] ? 1U : 0U;
            samples += wanted.visibility.size();
            for (pipeline::Count const& reason : got.redraw_reasons) scrolls += reason.name == "volume_moved" ? reason.value : 0;
        }
        std::printf("town %s on the device: %zu frames, %llu maps scrolled, %llu texels differ, %llu of %llu samples\n", path.c_str(), end - first,
                    static_cast<unsigned long long>(scrolls), static_cast<unsigned long long>(other_texels),
                    static_cast<unsigned long long>(other_visibility), static_cast<unsigned long long>(samples));
        CHECK(other_texels == 0);
        CHECK(other_visibility == 0);
        CHECK(scrolls >= 2 * (end - first - 1));
    }
    CHECK(device->take_messages() == "");
}

}  // namespace

TEST_CASE("cascades that scroll on the device are those that the CPU draws anew", "[vulkan][cascade]") {
    fly_on_device("both", 10, 20, 23, {});
}

TEST_CASE("cascades that scroll on the device are the CPU's, in many frames", "[vulkan][cascade][.full]") {
    fly_on_device("street", 10, 0, 150, {});
    fly_on_device("spin", 0, 0, 150, {{"depth", "reversed"}});
}
