#include "embree_peer.hpp"

#include <gnomon/scene/flatten.hpp>

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

namespace truth {

namespace {

using namespace gnomon;

struct DeviceDelete {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDelete {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDelete>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDelete>;

/// Embree's context, and after it the triangle that a ray must not hit.
struct Context {
    RTCIntersectContext base;
    std::uint32_t own_triangle;
};

void skip_own(RTCFilterFunctionNArguments const* arguments) {
    auto const* context = reinterpret_cast<Context const*>(arguments->context);
    auto const* hit = reinterpret_cast<RTCHit const*>(arguments->hit);
    if (hit->primID == context->own_triangle) arguments->valid[0] = 0;
}

Scene build(Device const& device, scene::Geometry const& geometry) {
    Scene scene(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    RTCGeometry const mesh = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const positions = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(math::vec3),
                                                    geometry.positions.size());
    std::memcpy(positions, geometry.positions.data(), geometry.positions.size() * sizeof(math::vec3));
    void* const indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                                  geometry.indices.size() / 3);
    std::memcpy(indices, geometry.indices.data(), geometry.indices.size() * sizeof(std::uint32_t));
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene.get(), mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
    return scene;
}

RTCRay ray_to_light(pipeline::Frame const& frame, math::vec3 const& from) {
    bool const sun = frame.light.kind == pipeline::LightKind::directional;
    math::vec3 const to = sun ? frame.to_light : frame.light_position - from;
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = to.x;
    ray.dir_y = to.y;
    ray.dir_z = to.z;
    ray.tfar = sun ? std::numeric_limits<float>::infinity() : 1.0F;
    ray.mask = ~0U;
    return ray;
}

}  // namespace

std::vector<std::uint32_t> embree_blockers(pipeline::Frame const& frame) {
    Device const device(rtcNewDevice(nullptr));
    if (!device) throw std::runtime_error("Embree gives no device");
    Scene const scene = build(device, *frame.geometry);
    Context context{};
    rtcInitIntersectContext(&context.base);
    context.base.filter = &skip_own;
    std::vector<std::uint32_t> blocker(frame.samples.size());
    for (std::size_t i = 0; i < blocker.size(); ++i) {
        context.own_triangle = frame.samples.triangle[i];
        RTCRayHit query{};
        query.ray = ray_to_light(frame, frame.samples.position[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene.get(), &context.base, &query);
        blocker[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_blocker : query.hit.primID;
    }
    return blocker;
}

}  // namespace truth
