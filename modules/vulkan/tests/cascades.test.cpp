// Cascades on a device: integer passes, scrolling and lookup together.

#include "../../pipeline/tests/cascade_runs.hpp"
#include "test_host.hpp"

#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

using namespace gnomon;

namespace {

struct Apart {
    std::uint64_t texels = 0;
    std::uint64_t samples = 0;
    std::uint64_t other_texels = 0;
    std::uint64_t other_samples = 0;
    std::uint64_t scrolls = 0;
};

/// A frame of `csm-scroll`, beside one that keeps nothing.
void compare_frame(test::CascadeRunner& csm, test::CascadeRunner& scroll, pipeline::Frame const& frame, Apart& sum) {
    auto const wanted = csm(frame);
    auto const got = scroll(frame);
    REQUIRE((csm.device.codes.size() == scroll.device.codes.size() && wanted.visibility.size() == got.visibility.size()));
    for (std::size_t t = 0; t < csm.device.codes.size(); ++t)
        sum.other_texels += csm.device.codes[t] != scroll.device.codes[t] ? 1U : 0U;
    for (std::size_t s = 0; s < wanted.visibility.size(); ++s)
        sum.other_samples += wanted.visibility[s] != got.visibility[s] ? 1U : 0U;
    sum.texels += csm.device.codes.size();
    sum.samples += wanted.visibility.size();
    for (pipeline::Count const& reason : got.redraw_reasons) sum.scrolls += reason.name == "volume_moved" ? reason.value : 0;
}

struct Flight {
    std::string path;
    double moving_percent = 0.0;
    std::size_t first = 0;
    std::size_t end = 0;
    std::vector<pipeline::Setting> settings;
    std::int32_t size_px = 512;
    bool beside_itself = false;  ///< Redrawn by the device; else by the CPU.
};

void fly_on_device(Flight const& flight) {
    vulkan::test::DeviceBackend on;
    {
        core::SerialExecutor executor;
        raster::CpuBackend cpu(executor);
        test::Town town(flight.path, flight.moving_percent);
        backend::Backend& redrawing = flight.beside_itself ? static_cast<backend::Backend&>(*on.gpu) : cpu;
        test::CascadeRunner csm(redrawing, "csm", flight.settings), scroll(*on.gpu, "csm-scroll", flight.settings);
        csm.device.size_px = scroll.device.size_px = flight.size_px;
        Apart sum;
        for (std::size_t i = flight.first; i < flight.end; ++i)
            compare_frame(csm, scroll, town.frame(i % town.path.frames.size()), sum);  // from its end back to its start: a jump
        std::printf("town %s on the device, %.0f %% moving, beside %s: %zu frames, %llu maps scrolled, %llu of %llu texels differ, %llu of %llu samples\n",
                    flight.path.c_str(), flight.moving_percent, flight.beside_itself ? "its own redraw" : "the CPU's", flight.end - flight.first,
                    static_cast<unsigned long long>(sum.scrolls), static_cast<unsigned long long>(sum.other_texels),
                    static_cast<unsigned long long>(sum.texels), static_cast<unsigned long long>(sum.other_samples),
                    static_cast<unsigned long long>(sum.samples));
        CHECK(sum.other_texels == 0);
        CHECK(sum.other_samples == 0);
        CHECK(sum.scrolls >= 2 * (flight.end - flight.first - 1));
    }
    CHECK(on.device->take_messages() == "");
}

}  // namespace

TEST_CASE("cascades that scroll on the device are those that the CPU draws anew", "[vulkan][cascade]") {
    fly_on_device({"both", 10, 20, 23, {}});
}

TEST_CASE("cascades that scroll on the device are the CPU's, in many frames", "[vulkan][cascade][.full]") {
    fly_on_device({"street", 10, 0, 150, {}});
    fly_on_device({"spin", 0, 0, 150, {{"depth", "reversed"}}});
}

// Small maps: the time goes into corners, as many for a map of any size. A texel is then twice as wide, and a strip as many.
TEST_CASE("cascades that scroll on the device are its own redraw, in a thousand frames", "[vulkan][cascade][.full]") {
    std::vector<pipeline::Setting> const small{{"resolution", "256"}};
    std::vector<pipeline::Setting> const reversed{{"resolution", "256"}, {"depth", "reversed"}};
    fly_on_device({"street", 10, 0, 250, small, 256, true});
    fly_on_device({"spin", 10, 0, 250, reversed, 256, true});
    fly_on_device({"both", 10, 0, 250, small, 256, true});
    fly_on_device({"both", 20, 0, 250, reversed, 256, true});
}
