#include <gnomon/check/check.hpp>
#include <gnomon/cull/depth_range.hpp>
#include <gnomon/math/scalar.hpp>

#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::check;

namespace {

__extension__ typedef __float128 DepthQuad;

}  // namespace

TEST_CASE("a ball that reaches a tile's depths is kept, one that clearly does not is not", "[cull][property]") {
    for_all(cases(20000), floats(0.1F, 1e4F), floats(0.0F, 1e3F), floats(-100.0F, 2e4F), integers(-3, 3),
            [](float near, float extent, float depth, int step) {
                cull::DepthRange const range{near, near + extent};
                // The radius that just reaches the nearer end, give or take a few units of the last place.
                float const gap = depth < near ? near - depth : depth > range.far_m ? depth - range.far_m : 0.0F;
                float const radius = math::from_ordinal(math::ordinal(gap) + (gap > 0.0F ? step : 0));
                DepthQuad const low = static_cast<DepthQuad>(depth) - static_cast<DepthQuad>(radius);
                DepthQuad const high = static_cast<DepthQuad>(depth) + static_cast<DepthQuad>(radius);
                bool const reaches = low <= static_cast<DepthQuad>(range.far_m) && high >= static_cast<DepthQuad>(near);
                if (reaches) CHECK(cull::may_touch(range, depth, radius));
                if (gap > 0.0F) CHECK_FALSE(cull::may_touch(range, depth, (gap - 1e-5F * (depth + near + extent)) * 0.999F));
            });
}

TEST_CASE("far only keeps what lies before the opaque depth; a reversed pass bounds the near side", "[cull]") {
    float const infinite = std::numeric_limits<float>::infinity();
    cull::DepthRange opaque;
    CHECK_FALSE(cull::may_touch(opaque, 5.0F, 100.0F));
    CHECK(cull::may_touch(far_only(opaque), 5.0F, 1.0F));
    for (float const depth : std::vector<float>{20.0F, 12.0F, std::numeric_limits<float>::quiet_NaN(), 15.0F}) opaque.add(depth);
    CHECK((opaque.near_m >= 12.0F && opaque.near_m <= 12.0F && opaque.far_m >= 20.0F && opaque.far_m <= 20.0F));
    CHECK_FALSE(cull::may_touch(opaque, 5.0F, 6.9F));
    CHECK(cull::may_touch(opaque, 5.0F, 7.0F));
    CHECK(cull::may_touch(far_only(opaque), 5.0F, 1.0F));
    CHECK_FALSE(cull::may_touch(far_only(opaque), 25.0F, 4.9F));
    CHECK_FALSE(cull::may_touch(transparent_range(opaque, 8.0F), 5.0F, 2.9F));
    CHECK(cull::may_touch(transparent_range(opaque, 8.0F), 5.0F, 3.0F));
    CHECK_FALSE(cull::may_touch(transparent_range(opaque, infinite), 5.0F, 3.0F));
    CHECK(cull::may_touch(opaque, 16.0F, 0.0F));
    CHECK_FALSE(cull::may_touch(opaque, 16.0F, -1.0F));
    CHECK_FALSE(cull::may_touch(opaque, std::numeric_limits<float>::quiet_NaN(), 1.0F));
}
