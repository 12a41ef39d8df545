#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/scan.hpp>

#include <algorithm>
#include <random>
#include <vector>

using namespace gnomon;
using vulkan::test::whole;
using vulkan::test::words_buffer;
using vulkan::test::words_of;

namespace {

struct Scanned {
    std::vector<std::uint32_t> sums;
    std::uint64_t total = 0;
};

/// The plain loop.
Scanned scanned_by_loop(std::vector<std::uint32_t> const& values) {
    Scanned out;
    for (std::uint32_t const v : values) {
        out.sums.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(out.total, ~0U)));
        out.total += v;
    }
    return out;
}

/// A device, buffers for `most` numbers, and a scan.
struct ScanBench {
    explicit ScanBench(std::uint32_t most)
        : device(vulkan::test::Device::make()),
          gpu(device->gpu()),
          sets(gpu, 1),
          values(words_buffer(gpu, most + 1)),
          sums(words_buffer(gpu, most + 1)),
          list(words_buffer(gpu, most + 1)),
          total(words_buffer(gpu, 2)) {
        auto made = vulkan::Scan::make(gpu, most);
        REQUIRE(made);
        scan = *std::move(made);
    }

    Scanned run(std::vector<std::uint32_t> const& in, bool in_place) {
        std::copy(in.begin(), in.end(), words_of(values).begin());
        std::fill_n(words_of(sums).begin(), in.size() + 1, 0xABCDEF01U);
        std::fill_n(words_of(total).begin(), 2, 0xABCDEF01U);
        vulkan::Buffer const& goal = in_place ? values : sums;
        std::uint32_t const beyond = words_of(goal)[in.size()];
        REQUIRE(sets.begin_frame({frame, frame}));
        ++frame;
        VkCommandBuffer const commands = device->begin();
        auto const count = static_cast<std::uint32_t>(in.size());
        REQUIRE(scan.record(commands, sets, {count, whole(values), whole(goal), whole(total)}));
        vulkan::order_for_host(*gpu, commands);
        device->submit_and_wait();
        CHECK(words_of(goal)[in.size()] == beyond);
        Scanned out;
        out.sums.assign(words_of(goal).begin(), words_of(goal).begin() + count);
        vulkan::ScanTotal const read{words_of(total)[0], words_of(total)[1]};
        out.total = read.value();
        CHECK(read.overflows() == (out.total > ~0U));
        return out;
    }

    void check_equal(std::vector<std::uint32_t> const& in, bool in_place = false) {
        Scanned const expected = scanned_by_loop(in);
        Scanned const got = run(in, in_place);
        CHECK(got.total == expected.total);
        CHECK((got.sums == expected.sums));
    }

    std::unique_ptr<vulkan::test::Device> device;
    vulkan::GpuRef gpu;
    vulkan::DescriptorRing sets;
    vulkan::Buffer values;
    vulkan::Buffer sums;
    vulkan::Buffer list;
    vulkan::Buffer total;
    vulkan::Scan scan;
    std::uint64_t frame = 0;
};

/// Numbers of which a share is 0, all below a bound that may be 2^32.
std::vector<std::uint32_t> random_numbers(std::size_t count, std::uint32_t seed, std::uint32_t highest) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& n : numbers) n = random() % 3 == 0 ? 0 : static_cast<std::uint32_t>(random()) & highest;
    return numbers;
}

}  // namespace

TEST_CASE("a scan is the loop's, bit for bit, for every size and every total", "[vulkan][scan]") {
    ScanBench bench(1'100'000);
    for (std::size_t const n : {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{65},
                                std::size_t{1023}, std::size_t{1024}, std::size_t{1025}, std::size_t{65537},
                                std::size_t{1'000'000}, std::size_t{1} << 20U, (std::size_t{1} << 20U) + 1}) {
        CAPTURE(n);
        bench.check_equal(std::vector<std::uint32_t>(n, 0));
        bench.check_equal(std::vector<std::uint32_t>(n, 1));
        bench.check_equal(std::vector<std::uint32_t>(n, ~0U));
        bench.check_equal(random_numbers(n, static_cast<std::uint32_t>(n), 0xFF), true);
        bench.check_equal(random_numbers(n, static_cast<std::uint32_t>(n), ~0U));
    }
    CHECK(bench.device->take_messages() == "");
}

TEST_CASE("a total at 2^32 is told from one below", "[vulkan][scan]") {
    ScanBench bench(5000);
    for (std::uint32_t const last : {0U, 1U, 2U, 100U}) {
        std::vector<std::uint32_t> in(4096, (1U << 20U) - 1);  // 2^32 - 4096
        in.push_back(4095);
        in.push_back(last);
        in.push_back(3);
        bench.check_equal(in, last == 2);
    }
    check::for_all(check::cases(60), check::integers<std::size_t>(0, 5000), check::integers<std::uint32_t>(0, ~0U),
                   check::integers<std::uint32_t>(0, 31), [&](std::size_t n, std::uint32_t seed, std::uint32_t bits) {
                       bench.check_equal(random_numbers(n, seed, ~0U >> bits), seed % 2 == 0);
                   });
    CHECK(bench.device->take_messages() == "");
}

TEST_CASE("a fill writes each item where the scan says, as far as the list reaches", "[vulkan][scan]") {
    ScanBench bench(20000);
    check::for_all(
        check::cases(60), check::integers<std::uint32_t>(0, 5000), check::integers<std::uint32_t>(0, ~0U),
        check::integers<std::uint32_t>(0, 3), check::integers<std::uint32_t>(0, 20000),
        [&](std::uint32_t n, std::uint32_t seed, std::uint32_t highest, std::uint32_t capacity) {
            std::vector<std::uint32_t> const counts = random_numbers(n, seed, highest);
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < n; ++i) expected.insert(expected.end(), counts[i], i);
            std::copy(counts.begin(), counts.end(), words_of(bench.values).begin());
            std::fill(words_of(bench.list).begin(), words_of(bench.list).end(), 0xABCDEF01U);
            REQUIRE(bench.sets.begin_frame({bench.frame, bench.frame}));
            ++bench.frame;
            VkCommandBuffer const commands = bench.device->begin();
            REQUIRE(bench.scan.record(commands, bench.sets,
                                      {n, whole(bench.values), whole(bench.sums), whole(bench.total)}));
            REQUIRE(bench.scan.fill(commands, bench.sets,
                                    {n, capacity, whole(bench.values), whole(bench.sums), whole(bench.list)}));
            vulkan::order_for_host(*bench.gpu, commands);
            bench.device->submit_and_wait();
            CHECK(words_of(bench.total)[0] == expected.size());  // what is needed, however much fits
            std::size_t const fits = std::min<std::size_t>(capacity, expected.size());
            CHECK(std::equal(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(fits),
                             words_of(bench.list).begin()));
            CHECK(words_of(bench.list)[fits] == 0xABCDEF01U);
        });
    CHECK(bench.device->take_messages() == "");
}

TEST_CASE("a scan of more numbers than it was made for is refused, and no failure leaks", "[vulkan][scan]") {
    ScanBench bench(100);
    auto const call = vulkan::ScanCall{101, whole(bench.values), whole(bench.sums), whole(bench.total)};
    auto const refused = bench.scan.record(VK_NULL_HANDLE, bench.sets, call);
    REQUIRE(!refused);
    CHECK(refused.failure().message.find("101") != std::string::npos);
    CHECK_FALSE(vulkan::Scan::make(bench.gpu, vulkan::max_scan_items + 1));
    std::int64_t const before = bench.device->live().total();
    std::uint64_t const calls = bench.device->live().calls;
    CHECK(vulkan::Scan::make(bench.gpu, 5000));
    std::uint64_t const made = bench.device->live().calls - calls;
    for (std::uint64_t n = 0; n < made; ++n) {
        bench.device->fail_call(n, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        CHECK_FALSE(vulkan::Scan::make(bench.gpu, 5000));
        CHECK(bench.device->live().total() == before);
    }
    CHECK(bench.device->take_messages() == "");
}

TEST_CASE("a scan of 2^24 numbers is the loop's", "[vulkan][scan][.full]") {
    ScanBench bench(vulkan::max_scan_items);
    bench.check_equal(random_numbers(vulkan::max_scan_items, 1, 0xFF));
    bench.check_equal(random_numbers(vulkan::max_scan_items, 2, ~0U), true);
    bench.check_equal(random_numbers(vulkan::max_scan_items - 1, 3, 0x1FF));
    CHECK(bench.device->take_messages() == "");
}
