#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/cluster/unique.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using cluster::no_cluster;
using cluster::no_key;

template <cluster::Key K>
struct UniqueCase {
    cluster::KeyLayout<K> layout;
    std::vector<K> keys;
};

template <cluster::Key K>
std::string check_string(UniqueCase<K> const& c) {
    return std::to_string(c.keys.size()) + " keys of " + std::to_string(c.layout.columns) + "x" + std::to_string(c.layout.rows) + "x" +
           std::to_string(c.layout.slices) + "x" + std::to_string(c.layout.cells);
}

template <cluster::Key K>
struct UniqueResult {
    std::vector<K> keys;
    std::vector<std::uint32_t> index;
    cluster::UniqueStats stats;

    friend bool operator==(UniqueResult const&, UniqueResult const&) = default;
};

/// From the definition: sort, unique, and a search for each sample.
template <cluster::Key K>
UniqueResult<K> unique_by_std(UniqueCase<K> const& c, std::size_t room) {
    UniqueResult<K> r;
    auto const is_one = [&](K key) { return c.layout.holds(cluster::unpack_key(key)); };
    for (K const key : c.keys) {
        if (is_one(key)) r.keys.push_back(key);
        else ++(key == no_key<K> ? r.stats.background : r.stats.invalid);
    }
    std::sort(r.keys.begin(), r.keys.end());
    r.keys.erase(std::unique(r.keys.begin(), r.keys.end()), r.keys.end());
    for (K const key : c.keys)
        r.index.push_back(is_one(key) ? static_cast<std::uint32_t>(std::lower_bound(r.keys.begin(), r.keys.end(), key) - r.keys.begin()) : no_cluster);
    r.stats.clusters = r.keys.size();
    r.keys.resize(std::min(room, r.keys.size()));
    return r;
}

enum class Method { bitmap, page_table, local_sort };

/// Any executor by reference: each method is compiled once.
template <cluster::Key K>
UniqueResult<K> unique_by(Method method, UniqueCase<K> const& c, std::size_t room, cluster::UniqueWorkspace<K>& work, core::ExecutorRef const& executor) {
    UniqueResult<K> r;
    r.keys.resize(room);
    r.index.assign(c.keys.size(), 12345);
    cluster::UniqueOut<K> const out{r.keys, r.index};
    std::span<K const> const keys(c.keys);
    switch (method) {
        case Method::bitmap: r.stats = unique_by_bitmap(c.layout, keys, out, work, executor); break;
        case Method::page_table: r.stats = unique_by_page_table(c.layout, keys, out, work, executor); break;
        case Method::local_sort: r.stats = unique_by_local_sort(c.layout, keys, out, work, executor); break;
    }
    r.keys.resize(std::min(room, r.stats.clusters));
    return r;
}

/// Runs, noise, background and keys of no layout.
template <cluster::Key K>
auto unique_cases(int most) {
    return [most](check::Choices& choices) {
        UniqueCase<K> c;
        auto const side = check::integers(1U, 40U);
        c.layout.columns = side(choices);
        c.layout.rows = side(choices);
        c.layout.slices = check::integers(1U, 300U)(choices);
        c.layout.normal_n = check::integers(0U, 3U)(choices);
        c.layout.cells = c.layout.normal_n == 0 ? 1U : 6 * c.layout.normal_n * c.layout.normal_n;
        auto const count = static_cast<std::size_t>(check::integers(0, most)(choices));
        std::uint64_t const longest = check::element_of({1ULL, 3ULL, 40ULL, 5000ULL})(choices);
        std::uint64_t const different = check::element_of({1ULL, 10ULL, 1ULL << 40U})(choices);
        std::uint64_t state = choices.draw(1000);
        auto const random = [&state] { return (state = state * 6364136223846793005ULL + 1442695040888963407ULL) >> 20U; };
        while (c.keys.size() < count) {
            std::uint64_t const kind = random() % 16;
            K key = c.layout.key(random() % std::min(c.layout.domain(), different));
            if (kind == 0) key = no_key<K>;
            if (kind == 1) key = static_cast<K>(random() << 20U | random());
            for (std::uint64_t n = 1 + random() % longest; n != 0 && c.keys.size() < count; --n) c.keys.push_back(key);
        }
        return c;
    };
}

template <cluster::Key K>
void check_all_methods(UniqueCase<K> const& c) {
    core::SerialExecutor const serial;
    core::ThreadExecutor const threads(3);
    static cluster::UniqueWorkspace<K> work;  // of the test: what earlier cases left must not matter
    for (std::size_t const room : {c.keys.size(), std::size_t{0}, c.keys.size() / 50}) {
        auto const expected = unique_by_std(c, room);
        for (Method const method : {Method::bitmap, Method::page_table, Method::local_sort}) {
            CHECK((unique_by(method, c, room, work, core::ExecutorRef(serial)) == expected));
            if (c.keys.size() > 20000) CHECK((unique_by(method, c, room, work, core::ExecutorRef(threads)) == expected));
        }
    }
}

}  // namespace

TEST_CASE("three methods find the same clusters in the same order, and each sample's place, as sorting does", "[cluster][property]") {
    check::for_all(check::cases(150), unique_cases<std::uint32_t>(600), check_all_methods<std::uint32_t>);
    check::for_all(check::cases(12), unique_cases<std::uint32_t>(70000), check_all_methods<std::uint32_t>);
    check::for_all(check::cases(12), unique_cases<std::uint64_t>(70000), check_all_methods<std::uint64_t>);
}

TEST_CASE("the machine's kernels find, number and fill runs as the plain ones do", "[cluster][property]") {
    check::for_all(check::cases(100), unique_cases<std::uint32_t>(3000), [](UniqueCase<std::uint32_t> const& c) {
        if (c.keys.empty()) return;
        cluster::detail::Block const block{0, static_cast<std::uint32_t>(c.keys.size())};
        cluster::UniqueWorkspace<std::uint32_t> ours;
        cluster::UniqueWorkspace<std::uint32_t> plain;
        std::vector<std::uint32_t> filled(c.keys.size());
        std::vector<std::uint32_t> expected(c.keys.size());
        ours.grow(1);
        plain.grow(1);
        cluster::detail::with_kernels([&](auto kernels) {
            ours.blocks[0] = kernels.find(c.layout, c.keys.data(), block, ours.runs(0));
            kernels.template fill<std::uint32_t>(ours.runs(0), block, filled.data());
        });
        plain.blocks[0] = cluster::detail::PlainKernels::find(c.layout, c.keys.data(), block, plain.runs(0));
        cluster::detail::PlainKernels::fill<std::uint32_t>(plain.runs(0), block, expected.data());
        auto const runs = static_cast<std::ptrdiff_t>(plain.blocks[0].runs);
        REQUIRE(ours.blocks[0].runs == plain.blocks[0].runs);
        CHECK(std::equal(ours.starts.begin(), ours.starts.begin() + runs + 1, plain.starts.begin()));
        CHECK(std::equal(ours.numbers.begin(), ours.numbers.begin() + runs, plain.numbers.begin()));
        CHECK(filled == expected);
        for (std::size_t i = 0; i < c.keys.size(); ++i) {
            bool const holds = c.layout.holds(cluster::unpack_key(c.keys[i]));
            CHECK(expected[i] == (holds ? c.layout.number(cluster::unpack_key(c.keys[i])) : no_cluster));
        }
    });
}

TEST_CASE("a layout too large for any table is left to the local sort", "[cluster]") {
    UniqueCase<std::uint64_t> c;
    c.layout = {65536, 65536, 65536, 6 * 104 * 104, 104};
    CHECK_FALSE(cluster::fits_table(c.layout));
    for (std::uint32_t i = 0; i < 40000; ++i)
        c.keys.push_back(cluster::pack_key<std::uint64_t>({i * 7919U % 65536, i * 104729U % 65536, i % 65536, i % 64896}));
    c.keys.push_back(no_key<std::uint64_t>);
    c.keys.push_back(cluster::pack_key<std::uint64_t>({65535, 65535, 65535, 64895}));
    c.keys.insert(c.keys.end(), c.keys.begin(), c.keys.begin() + 20000);
    cluster::UniqueWorkspace<std::uint64_t> work;
    core::SerialExecutor const serial;
    CHECK((unique_by(Method::local_sort, c, c.keys.size(), work, core::ExecutorRef(serial)) == unique_by_std(c, c.keys.size())));
}

TEST_CASE("unique clusters are found without allocating once the workspace has grown", "[cluster]") {
    UniqueCase<std::uint32_t> c;
    c.layout = {60, 34, 200, 1, 0};
    for (std::uint32_t i = 0; i < 100000; ++i) c.keys.push_back(c.layout.key(i * 2654435761U / 64 % c.layout.domain() / 3 * 2));
    cluster::UniqueWorkspace<std::uint32_t> work;
    std::vector<std::uint32_t> keys(c.keys.size());
    std::vector<std::uint32_t> index(c.keys.size());
    cluster::UniqueOut<std::uint32_t> const out{keys, index};
    std::span<std::uint32_t const> const in(c.keys);
    core::SerialExecutor const serial;
    core::ExecutorRef const executor(serial);
    auto const run = [&] {
        std::size_t const a = unique_by_bitmap(c.layout, in, out, work, executor).clusters;
        std::size_t const b = unique_by_page_table(c.layout, in, out, work, executor).clusters;
        return a + b + unique_by_local_sort(c.layout, in, out, work, executor).clusters;
    };
    std::size_t const first = run();
    std::uint64_t const before = check::allocations_made();
    CHECK(run() == first);
    CHECK(check::allocations_made() == before);
}
