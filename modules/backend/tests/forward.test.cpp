#include <gnomon/backend/forward.hpp>
#include <gnomon/backend/null.hpp>
#include <gnomon/check/check.hpp>

#include <array>

namespace {

using namespace gnomon;

/// Forgets every write.
class Forgetful final : public backend::Forward {
  public:
    using Forward::Forward;
    int writes = 0;

    backend::Result<backend::Done> write(backend::BufferId, std::size_t, std::span<std::byte const>) override {
        ++writes;
        return backend::Done{};
    }
};

}  // namespace

TEST_CASE("a forwarding backend hands on all that it does not override", "[backend][forward]") {
    backend::NullBackend null;
    Forgetful device(null);
    CHECK(device.name() == "null");
    auto const buffer = device.make_buffer(16);
    REQUIRE(buffer);
    CHECK(null.live() == 1);
    std::array<std::byte, 99> const bytes{};
    CHECK_FALSE(null.write(*buffer, 0, bytes));
    CHECK(device.write(*buffer, 0, bytes));
    CHECK(device.writes == 1);
    device.stage("a");
    CHECK(device.finish()->size() == 1);
    CHECK(device.release(*buffer));
    CHECK(null.live() == 0);
}
