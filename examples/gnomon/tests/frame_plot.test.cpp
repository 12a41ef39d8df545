#include "frame_plot.hpp"

#include <gnomon/check/check.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

using namespace gnomon::command;

TEST_CASE("an axis ends at the least round number that holds every value", "[frame-plot]") {
    CHECK(round_up(0.0) == 1.0);
    CHECK(round_up(-3.0) == 1.0);
    CHECK(round_up(std::numeric_limits<double>::quiet_NaN()) == 1.0);
    CHECK(round_up(7.0) == 10.0);
    CHECK(round_up(20.0) == 20.0);
    CHECK(round_up(21.0) == 50.0);
    CHECK(std::abs(round_up(0.013) - 0.02) < 1e-12);
    for (double value = 1e-6; value < 1e6; value *= 1.37) {
        CHECK(round_up(value) >= value);
        CHECK(round_up(value) < value * 2.51);
    }
}

TEST_CASE("every value of every series is a point inside the picture, higher for more", "[frame-plot]") {
    std::vector<FrameSeries> const series = {{"a <b>", {0.0, 5.0, 10.0}}, {"c", {2.5, 2.5, 2.5}}};
    std::string const svg = frame_plot_svg(series, "ms");
    CHECK(svg.find("a &lt;b&gt;") != std::string::npos);
    std::vector<double> heights;
    for (std::size_t at = svg.find("points='"); at != std::string::npos; at = svg.find("points='", at + 1)) {
        std::istringstream in(svg.substr(at + 8, svg.find('\'', at + 8) - at - 8));
        for (std::string point; in >> point;) {
            std::size_t const comma = point.find(',');
            double const x = std::strtod(point.c_str(), nullptr);
            heights.push_back(std::strtod(point.c_str() + comma + 1, nullptr));
            CHECK(x >= 0.0);
            CHECK(x <= 920.0);
            CHECK(heights.back() >= 0.0);
            CHECK(heights.back() <= 220.0);
        }
    }
    REQUIRE(heights.size() == 6);
    CHECK(heights[0] > heights[1]);
    CHECK(heights[1] > heights[2]);
    CHECK(heights[3] == heights[4]);
}

TEST_CASE("one frame, or none, is drawn too", "[frame-plot]") {
    std::vector<FrameSeries> const one = {{"a", {3.0}}};
    CHECK(frame_plot_svg(one, "ms").find("nan") == std::string::npos);
    CHECK(frame_plot_svg({}, "ms").find("inf") == std::string::npos);
}
