// Shows: cases of for_all per second, beside a bare loop over the same generators and the same check.
#define GNOMON_CHECK_MAIN
#define GNOMON_CHECK_NO_MAIN
#include <gnomon/check/check.hpp>

#include <benchmark/benchmark.h>

using namespace gnomon::check;

namespace {

constexpr std::uint64_t case_count = 1000000;

TEST_CASE("integers: bool") {
    for_all(cases(case_count), integers(-1000, 1000), integers(-1000, 1000), [](int a, int b) { return (a + b) * (a - b) == a * a - b * b; });
}
TEST_CASE("integers: CHECK") {
    for_all(cases(case_count), integers(-1000, 1000), integers(-1000, 1000), [](int a, int b) { CHECK((a + b) * (a - b) == a * a - b * b); });
}
TEST_CASE("integers: two CHECK and INFO") {
    for_all(cases(case_count), integers(-1000, 1000), integers(-1000, 1000), [](int a, int b) {
        INFO("a " << a << " b " << b);
        CHECK((a + b) * (a - b) == a * a - b * b);
        CHECK(a - b == -(b - a));
    });
}
TEST_CASE("floats: CHECK") {
    for_all(cases(case_count), any_float<float>(), floats(0.0, 1.0), [](float a, double b) { CHECK(a == a + 0.0f * static_cast<float>(b)); });
}

void run_test(benchmark::State& state, char const* name) {
    char const* const arguments[] = {"bench", name};
    for (auto _ : state)
        if (detail::run_program(2, arguments) != 0) state.SkipWithError("failed");
    state.SetItemsProcessed(static_cast<std::int64_t>(case_count) * static_cast<std::int64_t>(state.iterations()));
}

void bare_loop(benchmark::State& state) {
    auto const g = integers(-1000, 1000);
    for (auto _ : state) {
        Choices choices(1, 0);
        for (std::uint64_t i = 0; i < case_count; ++i) {
            choices.begin_case(i);
            int const a = g(choices), b = g(choices);
            bool same = (a + b) * (a - b) == a * a - b * b;
            benchmark::DoNotOptimize(same);
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(case_count) * static_cast<std::int64_t>(state.iterations()));
}

}  // namespace

BENCHMARK(bare_loop)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_test, integers_bool, "integers: bool")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_test, integers_check, "integers: CHECK")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_test, integers_two_checks_info, "integers: two CHECK and INFO")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_test, floats_check, "floats: CHECK")->Unit(benchmark::kMillisecond);
