#pragma once
// Embree on the same floats, in ROBUST mode: the independent check of the tests, the peer of the benchmarks.
#if defined(GNOMON_HAS_EMBREE)

#include <gnomon/core/id.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/segment.hpp>

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace peer {

/// Owns a device and a scene of one mesh. The triangle list must stay.
class EmbreeScene {
public:
    EmbreeScene(gnomon::predicates::TriangleList const& list, char const* config,
                RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM)
        : device_(rtcNewDevice(config)) {
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        rtcSetSceneBuildQuality(scene_, quality);
        RTCGeometry const mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, list.corners.data(), 0,
                                   sizeof(gnomon::math::uvec3), list.corners.size());
        // Embree may read 16 bytes for each vertex; the last one is copied with the others into its own buffer.
        auto* const to = static_cast<gnomon::math::vec3*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(gnomon::math::vec3), list.positions.size()));
        for (std::size_t i = 0; i < list.positions.size(); ++i) to[i] = list.positions[i];
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene_);
    }
    EmbreeScene(EmbreeScene const&) = delete;
    EmbreeScene& operator=(EmbreeScene const&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    [[nodiscard]] bool is_blocked(gnomon::trace::Segment const& s, gnomon::core::TriangleId own) const {
        struct Context {
            RTCIntersectContext context;
            std::uint32_t own;
        } context{};
        rtcInitIntersectContext(&context.context);
        context.own = own.value;
        context.context.filter = [](RTCFilterFunctionNArguments const* args) {
            auto const* const self = reinterpret_cast<Context const*>(args->context);
            if (RTCHitN_primID(args->hit, args->N, 0) == self->own) args->valid[0] = 0;
        };
        RTCRay ray{};
        gnomon::math::vec3 const extent = s.end.at_infinity ? s.end.xyz : s.end.xyz - s.start;
        ray.org_x = s.start.x;
        ray.org_y = s.start.y;
        ray.org_z = s.start.z;
        ray.dir_x = extent.x;
        ray.dir_y = extent.y;
        ray.dir_z = extent.z;
        ray.tnear = 0.0F;
        ray.tfar = s.end.at_infinity ? std::numeric_limits<float>::infinity() : 1.0F;
        ray.mask = ~0U;
        rtcOccluded1(scene_, &context.context, &ray);
        return ray.tfar < 0.0F;
    }

private:
    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

}  // namespace peer

#endif
