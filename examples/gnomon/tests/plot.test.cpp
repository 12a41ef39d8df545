#include "plot.hpp"

#include <gnomon/check/check.hpp>

#include <cmath>

using namespace gnomon::command;

TEST_CASE("an axis holds every positive value and ends on round numbers", "[plot]") {
    for (double const low : {1e-7, 0.3, 1.0, 19.0, 20.0, 999.0})
        for (double const factor : {1.0, 3.0, 1e3, 1e6}) {
            std::vector<double> const values = {low, low * factor, 0.0, std::nan("")};
            LogAxis const axis = axis_over(values);
            CAPTURE(low, factor);
            CHECK(axis.fraction(low) > 0.0);
            CHECK(axis.fraction(low * factor) < 1.0);
            CHECK(axis.high / axis.low > 4.8);
            CHECK(axis.ticks().size() >= 2);
            CHECK(axis.ticks().size() <= 16);
        }
    LogAxis const empty = axis_over({});
    CHECK(empty.low == 1.0);
    CHECK(empty.high == 10.0);
}

TEST_CASE("ticks go 1, 2, 5, 10", "[plot]") {
    std::vector<double> const values = {1.5, 30.0};
    std::vector<double> const ticks = axis_over(values).ticks();
    REQUIRE(ticks.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(ticks[i] == Approx((std::vector<double>{1.0, 2.0, 5.0, 10.0, 20.0, 50.0}[i])));
}

TEST_CASE("names from files cannot become markup", "[plot]") {
    CHECK(escaped("<b a='x' c=\"y\">&") == "&lt;b a=&#39;x&#39; c=&quot;y&quot;&gt;&amp;");
    std::vector<PlotPoint> const points = {{"</svg><script>", "a", 10.0, 0.1}};
    CHECK(plot_svg(points, {}, std::nullopt).find("<script>") == std::string::npos);
}

TEST_CASE("a plot of exact, of instant and of no runs has no NaN in it", "[plot]") {
    std::vector<PlotPoint> const points = {{"ray", "ray", 480.0, 0.0}, {"a", "a", 0.0, 1.0}, {"b", "b", 1e-9, 1e-12}};
    for (std::size_t n = 0; n <= points.size(); ++n) {
        std::string const svg = plot_svg(std::span(points).first(n), {}, n == 0 ? std::nullopt : std::optional(RayTime{480.0}));
        CHECK(svg.find("nan") == std::string::npos);
        CHECK(svg.find("inf") == std::string::npos);
        CHECK(svg.ends_with("</svg>\n"));
    }
}

TEST_CASE("series are numbered by appearance", "[plot]") {
    std::vector<PlotPoint> const points = {{"a1", "a", 1, 1}, {"r", "ray", 1, 1}, {"a2", "a", 1, 1}, {"c", "c", 1, 1}};
    CHECK(series_index(points, "a") == 0);
    CHECK(series_index(points, "ray") == 1);
    CHECK(series_index(points, "c") == 2);
}
