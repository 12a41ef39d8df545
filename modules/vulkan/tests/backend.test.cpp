#include "test_kernels.hpp"
#include "test_host.hpp"

#include <gnomon/backend/kernel.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <numeric>
#include <optional>
#include <vector>

using namespace gnomon;
using vulkan::test::Affine;
using vulkan::test::affine_kernel;

namespace {

std::unique_ptr<vulkan::Backend> backend_on(vulkan::GpuRef gpu, vulkan::Host const& host) {
    auto made = vulkan::Backend::make(std::move(gpu), host);
    REQUIRE(made);
    return *std::move(made);
}

/// One frame: writes, two runs, two reads. The numbers that come out; none where a verb failed, which `why` then says.
std::optional<std::vector<std::uint32_t>> affine_frame(backend::Backend& b, std::uint32_t n, std::uint32_t seed,
                                                       std::optional<backend::Error>* why = nullptr) {
    auto const failed = [&](auto const& result) {
        if (!result && why != nullptr) *why = result.failure().code;
        return !result;
    };
    std::vector<std::uint32_t> in(n);
    std::iota(in.begin(), in.end(), seed);
    auto const first = b.make_buffer(n * 4);
    if (failed(first)) return std::nullopt;
    auto const second = b.make_buffer(n * 4);
    if (failed(second)) return std::nullopt;
    b.stage("upload");
    if (failed(b.write(*first, 0, std::as_bytes(std::span(in))))) return std::nullopt;
    b.stage("run");
    backend::BufferId const there[] = {*first, *second};
    backend::BufferId const back[] = {*second, *first};
    Affine const one{n, 3, 1};
    Affine const two{n, 5, seed};
    if (failed(b.run(affine_kernel, {n, there, {}, backend::bytes_of(one)}))) return std::nullopt;
    if (failed(b.run(affine_kernel, {n, back, {}, backend::bytes_of(two)}))) return std::nullopt;
    std::vector<std::uint32_t> out(n);
    if (failed(b.read(*first, 0, std::as_writable_bytes(std::span(out))))) return std::nullopt;
    if (failed(b.release(*first)) || failed(b.release(*second))) return std::nullopt;
    if (failed(b.finish())) return std::nullopt;
    return out;
}

bool is_right(std::vector<std::uint32_t> const& out, std::uint32_t seed) {
    for (std::uint32_t i = 0; i < out.size(); ++i)
        if (out[i] != ((seed + i) * 3 + 1) * 5 + seed) return false;
    return true;
}

}  // namespace

TEST_CASE("a frame of writes, kernels and reads gives what they say, and waits only at its end", "[vulkan][backend]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    {
        vulkan::test::TestHost host(*device);
        auto const b = backend_on(device->gpu(), host.host());
        for (std::uint32_t frame = 0; frame < 5; ++frame) {
            auto const out = affine_frame(*b, 1000 + frame, frame * 7);
            REQUIRE(out);
            CHECK(is_right(*out, frame * 7));
            CHECK(host.begins == frame + 1);
            CHECK(host.submits == frame + 1);
        }
        b->stage("nothing");
        b->stage("");
        b->stage("nothing either");
        auto const times = b->finish();
        REQUIRE(times);
        REQUIRE(times->size() == 2);  // what follows an empty name is not timed
        CHECK((*times)[0].name == "nothing");
        CHECK((*times)[1].name == "nothing either");
        CHECK((*times)[0].ms >= 0.0);
        CHECK(b->finish()->empty());  // nothing recorded, nothing submitted
        CHECK(host.submits == 6);
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("verbs see what came before them: a read in the middle of a frame", "[vulkan][backend]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::TestHost host(*device);
    auto const b = backend_on(device->gpu(), host.host());
    auto const buffer = b->make_buffer(10);  // no multiple of 4
    REQUIRE(buffer);
    std::vector<std::byte> bytes(10, std::byte{1});
    std::vector<std::byte> before(10);
    std::vector<std::byte> after(3);
    REQUIRE(b->write(*buffer, 0, bytes));
    bytes.assign(10, std::byte{9});  // what a verb was given may change
    REQUIRE(b->read(*buffer, 0, before));
    REQUIRE(b->write(*buffer, 5, std::span(bytes).first(2)));
    REQUIRE(b->read(*buffer, 4, after));
    REQUIRE(b->finish());
    CHECK(before == std::vector<std::byte>(10, std::byte{1}));
    CHECK(after == std::vector<std::byte>{std::byte{1}, std::byte{9}, std::byte{9}});
    CHECK(device->take_messages() == "");
}

TEST_CASE("what a verb cannot do it refuses with a sentence, and records nothing", "[vulkan][backend]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::TestHost host(*device);
    vulkan::GpuRef const gpu = device->gpu();
    auto const b = backend_on(gpu, host.host());
    auto const buffer = b->make_buffer(16);
    REQUIRE(buffer);
    std::byte bytes[32] = {};
    auto const code = [](auto const& result) { return result ? std::nullopt : std::optional(result.failure().code); };
    CHECK(code(b->write(backend::BufferId{77}, 0, bytes)) == backend::Error::bad_argument);
    CHECK(code(b->write(*buffer, 0, bytes)) == backend::Error::bad_argument);
    CHECK(code(b->read(*buffer, 8, std::span(bytes).first(9))) == backend::Error::bad_argument);
    CHECK(code(b->make_buffer(0)) == backend::Error::bad_argument);
    CHECK(code(b->make_buffer(std::size_t{1} << 40U)) == backend::Error::too_large);
    CHECK(b->limits().buffer_bytes <= gpu->properties.limits.maxStorageBufferRange);
    Affine const affine{1, 1, 1};
    backend::BufferId const buffers[] = {*buffer, backend::BufferId{78}};
    CHECK(code(b->run(affine_kernel, {1, buffers, {}, backend::bytes_of(affine)})) == backend::Error::bad_argument);
    CHECK(code(b->run(affine_kernel, {1, {}, {}, {}})) == backend::Error::bad_argument);
    backend::Kernel const cpu_only{.name = "cpu_only", .cpu = affine_kernel.cpu, .spirv = {}, .buffers = 1};
    auto const refused = b->run(cpu_only, {1, std::span(buffers).first(1), {}, {}});
    CHECK(code(refused) == backend::Error::missing_feature);
    CHECK(refused.failure().message.find("cpu_only") != std::string::npos);
    CHECK(host.begins == 0);
    REQUIRE(b->release(*buffer));
    CHECK(code(b->release(*buffer)) == backend::Error::bad_argument);
    CHECK(code(b->write(*buffer, 0, std::span(bytes).first(4))) == backend::Error::bad_argument);
    vulkan::Host const forgetful{nullptr,
                                 [](void*, VkCommandBuffer&) { return VK_SUCCESS; },
                                 [](void*, VkCommandBuffer) { return VK_SUCCESS; }};
    auto const c = backend_on(gpu, forgetful);
    CHECK(code(c->write(*c->make_buffer(4), 0, std::span(bytes).first(4))) == backend::Error::bad_argument);
    CHECK_FALSE(vulkan::Backend::make(nullptr, host.host()));
    CHECK_FALSE(vulkan::Backend::make(gpu, {}));
    CHECK(device->take_messages() == "");
}

TEST_CASE("whichever call of the device fails, the verb says so and nothing leaks", "[vulkan][backend]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    std::uint64_t calls = 0;
    for (std::uint64_t n = 0; n <= calls; ++n) {
        vulkan::test::TestHost host(*device);
        {
            auto const b = backend_on(device->gpu(), host.host());
            std::uint64_t const before = device->live().calls;
            std::optional<backend::Error> why;
            if (n > 0) device->fail_call(n - 1, n % 2 == 0 ? VK_ERROR_OUT_OF_HOST_MEMORY : VK_ERROR_OUT_OF_DEVICE_MEMORY);
            auto const out = affine_frame(*b, 300, 5, &why);
            if (n == 0) calls = device->live().calls - before;
            CHECK(out.has_value() == (n == 0));
            if (n > 0) CHECK(why == backend::Error::out_of_memory);
            if (host.submits < host.begins) {  // the next frame works: out of memory ends nothing
                REQUIRE(b->finish());
            }
            auto const again = affine_frame(*b, 300, 6, &why);
            REQUIRE(again);
            CHECK(is_right(*again, 6));
        }
        CHECK(device->live().total() == 0);
    }
    CHECK(calls > 10);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a lost device is said once and for all", "[vulkan][backend]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    bool const at_begin = GENERATE(0, 1) == 1;
    vulkan::test::TestHost host(*device);
    {
        auto const b = backend_on(device->gpu(), host.host());
        REQUIRE(affine_frame(*b, 64, 1));
        (at_begin ? host.begin_result : host.submit_result) = VK_ERROR_DEVICE_LOST;
        std::optional<backend::Error> why;
        CHECK_FALSE(affine_frame(*b, 64, 2, &why));
        CHECK(why == backend::Error::device_lost);
        std::uint64_t const begins = host.begins;
        CHECK(b->finish().failure().code == backend::Error::device_lost);
        CHECK(b->make_buffer(4).failure().code == backend::Error::device_lost);
        b->stage("after");
        CHECK(host.begins == begins);  // the host is left alone
        CHECK_THAT(b->finish().failure().message, check::Contains("VK_ERROR_DEVICE_LOST"));
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}
