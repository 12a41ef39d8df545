#include "test_kernels.hpp"
#include "pass_scenes.hpp"
#include "test_host.hpp"

#include <gnomon/backend/verbs.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

constexpr math::ivec2 verb_size{32, 16};
constexpr std::uint32_t verb_pixels = 32 * 16;

/// Rectangles of whole pixels and one depth each, all of it exact in float: what differs between backends is a verb's
/// fault, not a rasterizer's.
Soup make_rectangles(std::uint64_t seed, int count) {
    Random random{seed};
    Soup soup;
    for (int i = 0; i < count; ++i) {
        auto const pixels = [&](std::uint64_t below) { return static_cast<float>(random.next() % below); };
        float const left = pixels(30) / 16.0F - 1.0F;
        float const top = pixels(14) / 8.0F - 1.0F;
        float const right = left + (1.0F + pixels(12)) / 16.0F;
        float const bottom = top + (1.0F + pixels(8)) / 8.0F;
        float const depth = (1.0F + pixels(63)) / 64.0F;
        for (math::vec2 const& p : {math::vec2(left, top), math::vec2(left, bottom), math::vec2(right, top),
                                    math::vec2(right, bottom)})
            soup.positions.emplace_back(p.x, p.y, depth);
        auto const first = static_cast<std::uint32_t>(4 * i);
        for (std::uint32_t const k : {0U, 1U, 2U, 2U, 1U, 3U}) soup.indices.push_back(first + k);
    }
    return soup;
}

/// Moved by whole pixels; clip space as it is.
backend::PassLayer layer_moved_by(int x, int y) {
    backend::PassLayer layer;
    layer.origin = {static_cast<float>(x) / 16.0F, static_cast<float>(y) / 8.0F, 0.0F};
    return layer;
}

/// What one verb did: whether it was taken, and what it read, filled when the frame has finished.
struct Outcome {
    backend::Error refused{};
    bool is_refused = false;
    bool is_code = false;
    std::vector<std::byte> read;

    template <class T>
    void set(backend::Result<T> const& result) {
        is_refused = !result;
        if (is_refused) refused = result.failure().code;
    }
};

/// A backend with three buffers, three targets and two lists, and verbs drawn at random.
class Verbs {
  public:
    Verbs(backend::Backend& b, std::span<Soup const> soups) : b_(b) {
        for (auto& buffer : buffers_) buffer = *b.make_buffer(verb_pixels * 4);
        backend::TargetConfig config{.size_px = verb_size, .layers = 2};
        targets_[0] = *b.make_target(config);
        config.triangle_ids = true;
        targets_[1] = *b.make_target(config);
        config.triangle_ids = false;
        config.depth = backend::DepthFormat::unorm16;
        targets_[2] = *b.make_target(config);
        for (std::size_t i = 0; i < 2; ++i) {
            backend::Draw const draw = soups[i].draw();
            lists_[i] = *b.keep({&draw, 1});
        }
        std::vector<std::byte> const zeros(verb_pixels * 4);
        for (auto const buffer : buffers_) REQUIRE(b.write(buffer, 0, zeros));
        for (auto const target : targets_) {  // nothing is left undefined
            backend::PassLayer layers[2] = {layer_moved_by(0, 0), layer_moved_by(1, 0)};
            layers[1].layer = 1;
            REQUIRE(b.draw(lists_[0], target, layers));
        }
    }

    /// The same verb for the same numbers.
    void step(std::uint64_t seed) {
        Random random{seed};
        auto const below = [&](std::uint64_t n) { return random.next() % n; };
        Outcome& outcome = outcomes_.emplace_back();
        switch (below(8)) {
            case 0: {
                std::vector<std::byte> bytes(below(700));
                for (std::byte& b : bytes) b = static_cast<std::byte>(random.next());
                outcome.set(b_.write(buffers_[below(3)], below(1000), bytes));
                break;
            }
            case 1: {
                std::size_t const from = below(3);
                backend::BufferId const both[] = {buffers_[from], buffers_[(from + 1 + below(2)) % 3]};
                auto const count = static_cast<std::uint32_t>(below(verb_pixels + 1));
                Affine const affine{count, static_cast<std::uint32_t>(below(9)), static_cast<std::uint32_t>(below(99))};
                outcome.set(b_.run(affine_kernel, {count, both, {}, backend::bytes_of(affine)}));
                break;
            }
            case 2: {
                backend::BufferId const out = buffers_[below(3)];
                backend::TargetBinding const in{targets_[below(2)]};
                Covered const covered{32, 16, static_cast<std::uint32_t>(below(2))};
                outcome.set(b_.run(covered_kernel, {verb_pixels, {&out, 1}, {&in, 1}, backend::bytes_of(covered)}));
                break;
            }
            case 3:
            case 4: draw(random, outcome); break;
            case 5: {
                backend::TargetPart const from{targets_[below(3)], static_cast<std::uint32_t>(below(3)),
                                               backend::Plane::depth, part(random)};
                math::ivec2 const at{static_cast<int>(below(8)), static_cast<int>(below(6))};
                outcome.set(b_.copy(from, targets_[below(3)], static_cast<std::uint32_t>(below(2)), at));
                break;
            }
            case 6: {
                outcome.read.resize(below(500));
                outcome.set(b_.read(buffers_[below(3)], below(1200), outcome.read));
                break;
            }
            default: {
                std::size_t const which = below(3);
                backend::Rect const rect = part(random);
                outcome.is_code = which == 2;
                outcome.read.resize(static_cast<std::size_t>(rect.width * rect.height) * (which == 2 ? 2 : 4));
                outcome.set(b_.read({targets_[which], static_cast<std::uint32_t>(below(2)), backend::Plane::depth, rect},
                                    outcome.read));
                break;
            }
        }
    }

    [[nodiscard]] std::deque<Outcome> finish() {
        REQUIRE(b_.finish());
        return std::exchange(outcomes_, {});
    }

  private:
    static backend::Rect part(Random& random) {
        auto const x = static_cast<std::int32_t>(random.next() % 20);
        auto const y = static_cast<std::int32_t>(random.next() % 14);
        return {x, y, static_cast<std::int32_t>(random.next() % 8), static_cast<std::int32_t>(random.next() % 6)};
    }

    void draw(Random& random, Outcome& outcome) {
        backend::PassLayer layers[2] = {};
        std::size_t const count = 1 + random.next() % 2;
        for (std::size_t i = 0; i < count; ++i) {
            layers[i] = layer_moved_by(static_cast<int>(random.next() % 9) - 4, static_cast<int>(random.next() % 5) - 2);
            layers[i].layer = static_cast<std::uint32_t>((i + random.next() % 2) % 2);
            if (random.next() % 2 == 0) layers[i].load = backend::Load::keep;
            if (random.next() % 3 == 0) layers[i].scissor = part(random);
        }
        std::size_t const target = random.next() % 3;
        auto const counts = b_.draw(lists_[random.next() % 2], targets_[target], std::span(layers).first(count));
        outcome.set(counts);
        if (counts) outcome.read.assign(static_cast<std::size_t>(counts->triangles % 97), std::byte{1});
    }

    backend::Backend& b_;
    backend::BufferId buffers_[3];
    backend::TargetId targets_[3];
    backend::DrawListId lists_[2];
    std::deque<Outcome> outcomes_;  ///< Stay where they are: reads point into them.
};

/// The same bits; codes of 16 bits within 1.
std::string difference_of(Outcome const& a, Outcome const& b) {
    if (a.is_refused != b.is_refused) return "one is refused";
    if (a.is_refused) return a.refused == b.refused ? "" : "refused for another reason";
    if (a.read.size() != b.read.size()) return "another size";
    auto const codes_of = [](Outcome const& o) {
        std::vector<std::uint16_t> codes(o.read.size() / 2);
        if (!codes.empty()) std::memcpy(codes.data(), o.read.data(), codes.size() * 2);
        return codes;
    };
    if (a.is_code) {
        auto const x = codes_of(a);
        auto const y = codes_of(b);
        for (std::size_t i = 0; i < x.size(); ++i)
            if (std::abs(x[i] - y[i]) > 1) return "code " + std::to_string(y[i]) + ", not " + std::to_string(x[i]);
        return "";
    }
    auto const at = std::mismatch(a.read.begin(), a.read.end(), b.read.begin()).first - a.read.begin();
    if (at == static_cast<std::ptrdiff_t>(a.read.size())) return "";
    return "byte " + std::to_string(at) + " of " + std::to_string(a.read.size());
}

}  // namespace

TEST_CASE("the same verbs give the same on the device and on the CPU, whatever their order", "[vulkan][backend]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    {
        TestHost host(*device);
        Soup const soups[] = {make_rectangles(3, 12), make_rectangles(4, 3)};
        core::SerialExecutor serial;
        raster::CpuBackend cpu{core::ExecutorRef(serial)};
        auto const gpu = vulkan::Backend::make(device->gpu(), host.host());
        REQUIRE(gpu);
        Verbs on_cpu(cpu, soups);
        Verbs on_gpu(**gpu, soups);
        (void)on_cpu.finish();
        (void)on_gpu.finish();
        std::uint64_t const made = device->live().calls;
        std::uint64_t verbs = 0;
        std::uint64_t refused = 0;
        check::for_all(check::cases(60), check::integers<std::uint64_t>(0, ~std::uint64_t{0}),
                       check::integers<std::uint64_t>(1, 60), [&](std::uint64_t seed, std::uint64_t count) {
                           for (std::uint64_t i = 0; i < count; ++i) {
                               on_cpu.step(seed + i);
                               on_gpu.step(seed + i);
                           }
                           auto const expected = on_cpu.finish();
                           auto const got = on_gpu.finish();
                           for (std::size_t i = 0; i < expected.size(); ++i) {
                               CAPTURE(i);
                               CHECK(difference_of(expected[i], got[i]) == "");
                               refused += expected[i].is_refused ? 1U : 0U;
                           }
                           verbs += expected.size();
                       });
        CHECK(verbs > 1000);
        CHECK(refused > 10);  // some do not fit: the same ones
        CHECK(refused < verbs / 2);
        CHECK(device->live().calls <= made + 16);  // two kernels, blocks of staging, pools of sets
        CHECK(host.submits == 61);
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages().substr(0, 500) == "");
}
