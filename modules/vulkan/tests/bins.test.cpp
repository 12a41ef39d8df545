#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/bins.hpp>

#include <algorithm>
#include <random>
#include <vector>

using namespace gnomon;
using vulkan::test::whole;
using vulkan::test::words_buffer;
using vulkan::test::words_of;

namespace {

struct Lists {
    std::vector<std::uint32_t> begins;
    std::vector<std::uint32_t> items;
};

/// The plain loop: for each bin, its items in order.
Lists lists_by_loop(std::vector<std::uint32_t> const& bin_of_item, std::uint32_t bins) {
    std::vector<std::vector<std::uint32_t>> of_bin(bins);
    for (std::uint32_t i = 0; i < bin_of_item.size(); ++i)
        if (bin_of_item[i] < bins) of_bin[bin_of_item[i]].push_back(i);
    Lists out;
    for (auto const& items : of_bin) {
        out.begins.push_back(static_cast<std::uint32_t>(out.items.size()));
        out.items.insert(out.items.end(), items.begin(), items.end());
    }
    out.begins.push_back(static_cast<std::uint32_t>(out.items.size()));
    return out;
}

struct BinBench {
    explicit BinBench(std::uint32_t most, std::uint32_t most_bins)
        : device(vulkan::test::Device::make()),
          gpu(device->gpu()),
          sets(gpu, 1),
          keys(words_buffer(gpu, most + 1)),
          begins(words_buffer(gpu, most_bins + 2)),
          list(words_buffer(gpu, most + 1)) {
        auto made = vulkan::BinLists::make(gpu, most);
        REQUIRE(made);
        lists = *std::move(made);
    }

    void check_equal(std::vector<std::uint32_t> const& in, std::uint32_t bins, std::uint32_t capacity) {
        constexpr std::uint32_t untouched = 0xABCDEF01U;
        Lists const expected = lists_by_loop(in, bins);
        std::copy(in.begin(), in.end(), words_of(keys).begin());
        std::fill(words_of(list).begin(), words_of(list).end(), untouched);
        words_of(begins)[bins + 1] = untouched;
        REQUIRE(sets.begin_frame({frame, frame}));
        ++frame;
        VkCommandBuffer const commands = device->begin();
        auto const count = static_cast<std::uint32_t>(in.size());
        REQUIRE(lists.record(commands, sets, {count, bins, capacity, whole(keys), whole(begins), whole(list)}));
        vulkan::order_for_host(*gpu, commands);
        device->submit_and_wait();
        CHECK(std::equal(expected.begins.begin(), expected.begins.end(), words_of(begins).begin()));
        CHECK(words_of(begins)[bins + 1] == untouched);
        std::size_t const fits = std::min<std::size_t>(capacity, expected.items.size());
        CHECK(std::equal(expected.items.begin(), expected.items.begin() + static_cast<std::ptrdiff_t>(fits),
                         words_of(list).begin()));
        CHECK(words_of(list)[fits] == untouched);
    }

    std::unique_ptr<vulkan::test::Device> device;
    vulkan::GpuRef gpu;
    vulkan::DescriptorRing sets;
    vulkan::Buffer keys;
    vulkan::Buffer begins;
    vulkan::Buffer list;
    vulkan::BinLists lists;
    std::uint64_t frame = 0;
};

std::vector<std::uint32_t> random_bins(std::size_t count, std::uint32_t seed, std::uint32_t below) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> bins(count);
    for (std::uint32_t& b : bins) b = random() % 8 == 0 ? ~0U : static_cast<std::uint32_t>(random() % below);
    return bins;
}

}  // namespace

TEST_CASE("lists per bin are those of a loop, in the items' order", "[vulkan][bins]") {
    BinBench bench(200'000, 70'000);
    for (std::uint32_t const bins : {0U, 1U, 15U, 16U, 17U, 255U, 256U, 4097U, 65536U, 70'000U})
        for (std::size_t const n : {std::size_t{0}, std::size_t{1}, std::size_t{1024}, std::size_t{1025}}) {
            CAPTURE(bins);
            CAPTURE(n);
            bench.check_equal(random_bins(n, bins, bins + 3), bins, 200'000);
        }
    bench.check_equal(random_bins(200'000, 7, 70'001), 70'000, 150'000);
    bench.check_equal(std::vector<std::uint32_t>(200'000, 12), 13, 200'000);
    bench.check_equal(std::vector<std::uint32_t>(200'000, 13), 13, 200'000);  // in no bin
    check::for_all(check::cases(40), check::integers<std::size_t>(0, 5000), check::integers<std::uint32_t>(0, ~0U),
                   check::integers<std::uint32_t>(0, 5000), check::integers<std::uint32_t>(0, 6000),
                   [&](std::size_t n, std::uint32_t seed, std::uint32_t bins, std::uint32_t capacity) {
                       bench.check_equal(random_bins(n, seed, bins + 1), bins, capacity);
                   });
    CHECK(bench.device->take_messages() == "");
}

TEST_CASE("more items or bins than lists are made for are refused, and no failure leaks", "[vulkan][bins]") {
    BinBench bench(10, 10);
    vulkan::BinCall call{11, 1, 1, whole(bench.keys), whole(bench.begins), whole(bench.list)};
    CHECK(bench.lists.record(VK_NULL_HANDLE, bench.sets, call).failure().code == vulkan::Error::too_large);
    call = {1, vulkan::max_bins + 1, 1, whole(bench.keys), whole(bench.begins), whole(bench.list)};
    CHECK(bench.lists.record(VK_NULL_HANDLE, bench.sets, call).failure().code == vulkan::Error::too_large);
    CHECK_FALSE(vulkan::BinLists::make(bench.gpu, vulkan::max_scan_items + 1));
    std::int64_t const before = bench.device->live().total();
    std::uint64_t const calls = bench.device->live().calls;
    CHECK(vulkan::BinLists::make(bench.gpu, 5000));
    std::uint64_t const made = bench.device->live().calls - calls;
    for (std::uint64_t n = 0; n < made; ++n) {
        bench.device->fail_call(n, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        CHECK_FALSE(vulkan::BinLists::make(bench.gpu, 5000));
        CHECK(bench.device->live().total() == before);
    }
    CHECK(bench.device->take_messages() == "");
}
