#include "parity.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/predicates/orient.hpp>
#include <gnomon/trace/filter.hpp>

#include "../../trace/tests/hard_segments.hpp"
#include "shaders/parity_ray_comp.hpp"

#include <cstdio>
#include <vector>

using namespace gnomon;
using vulkan::test::ParityKernel;

namespace {

struct RayItem {
    trace::Triangle triangle;
    trace::Segment segment;
    math::vec3 eye;
};

RayItem ray_item(segments::Random& random) {
    for (;;) {
        segments::Scale const scale = segments::any_scale(random);
        trace::Triangle const t = segments::triangle_of(random, scale);
        trace::Segment const s = segments::segment_at(random, t, scale);
        math::vec3 const eye = segments::point_of(random, scale);
        bool const legal = is_valid(s) && trace::detail::in_range(s.start) && trace::detail::in_range(eye) &&
                           (s.end.at_infinity || trace::detail::in_range(s.end.xyz));
        if (legal) return {t, s, eye};
    }
}

void add_point(std::vector<std::uint32_t>& words, math::vec3 const& p) {
    for (int axis = 0; axis < 3; ++axis) words.push_back(std::bit_cast<std::uint32_t>(p[axis]));
}

std::vector<std::uint32_t> ray_words(std::vector<RayItem> const& items) {
    std::vector<std::uint32_t> words;
    for (RayItem const& item : items) {
        for (math::vec3 const& corner : item.triangle) add_point(words, corner);
        add_point(words, item.segment.start);
        add_point(words, item.segment.end.xyz);
        add_point(words, item.eye);
        words.push_back(item.segment.end.at_infinity ? 0U : 1U);
        words.push_back(0U);
    }
    return words;
}

struct RayParity {
    int sure = 0;
    int wrong = 0;      ///< Certain of what is not so.
    int untouched = 0;  ///< Blocked, and the box about the triangle not touched.
    int different = 0;  ///< From the same filter in C++: may be, where a device rounds otherwise.
};

void count_answers(RayItem const& item, std::span<std::uint32_t const> device, RayParity& sum) {
    using trace::Answer;
    predicates::Target const eye = predicates::Target::point(item.eye);
    trace::Triangle const& t = item.triangle;
    trace::Segment const& s = item.segment;
    bool const blocked = blocks(t, s);
    bool const away = predicates::separates(t[0], t[1], t[2], eye, s.end);
    sum.sure += device[0] != 2 ? 1 : 0;
    sum.wrong += device[0] != 2 && (device[0] == 1) != blocked ? 1 : 0;
    sum.wrong += device[2] != 2 && (device[2] == 1) != away ? 1 : 0;
    sum.untouched += blocked && device[1] == 0 ? 1 : 0;
    sum.different += device[0] != static_cast<std::uint32_t>(trace::filter_blocks(t, s)) ||
                             device[2] != static_cast<std::uint32_t>(trace::filter_separates(t, eye, s.end))
                         ? 1
                         : 0;
}

}  // namespace

TEST_CASE("the device's ray filter never decides one of 1e6 hard triangles wrongly", "[vulkan][parity][ray]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    ParityKernel const kernel{"parity_ray", vulkan::test::parity_ray_comp, 20, 4};
    segments::Random random{91};
    RayParity sum;
    for (int chunk = 0; chunk < 8; ++chunk) {
        std::vector<RayItem> items;
        for (int i = 0; i < 125'000; ++i) items.push_back(ray_item(random));
        auto const answers = vulkan::test::run_on_device(*device, kernel, ray_words(items));
        for (std::size_t i = 0; i < items.size(); ++i)
            count_answers(items[i], std::span(answers).subspan(4 * i, 4), sum);
    }
    std::printf("ray filter: %d of 1000000 hard triangles decided, %d otherwise than in C++\n", sum.sure,
                sum.different);
    CHECK(sum.wrong == 0);
    CHECK(sum.untouched == 0);
    CHECK(sum.sure > 400'000);
    CHECK(device->take_messages() == "");
}
