// The constants of the pipeline's kernels: their shaders lay them out as their C++ structs do.

#include "../../pipeline/src/shadow/kernels.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include <cstddef>
#include <utility>
#include <vector>

using namespace gnomon;

namespace {

using Places = std::vector<std::pair<std::size_t, std::size_t>>;  ///< Offset and bytes of each member.

Places places_of(backend::Kernel const& kernel) {
    Places places;
    for (vulkan::ShaderMember const& member : vulkan::members_of(kernel.spirv, "Constants"))
        places.emplace_back(member.offset, member.bytes);
    return places;
}

template <class T>
std::pair<std::size_t, std::size_t> place(std::size_t offset) {
    return {offset, sizeof(T)};
}

}  // namespace

#define GNOMON_PLACE(Struct, member) place<decltype(Struct::member)>(offsetof(Struct, member))
#define GNOMON_PLACE_OF_VECTOR(Struct, member) \
    place<float>(offsetof(Struct, member)), place<float>(offsetof(Struct, member) + 4), place<float>(offsetof(Struct, member) + 8)

TEST_CASE("the pipeline's kernels read their constants where C++ writes them", "[vulkan][spirv]") {
    using pipeline::RayStd;
    using pipeline::ShadowLookupStd;
    CHECK(places_of(pipeline::shadow_lookup_kernel) ==
          Places{GNOMON_PLACE(ShadowLookupStd, count), GNOMON_PLACE(ShadowLookupStd, maps),
                 GNOMON_PLACE(ShadowLookupStd, unorm16), GNOMON_PLACE_OF_VECTOR(ShadowLookupStd, light),
                 GNOMON_PLACE(ShadowLookupStd, config)});
    CHECK(places_of(pipeline::ray_kernel) ==
          Places{GNOMON_PLACE(RayStd, count), GNOMON_PLACE(RayStd, nodes), GNOMON_PLACE(RayStd, positions),
                 GNOMON_PLACE(RayStd, triangles), GNOMON_PLACE_OF_VECTOR(RayStd, light),
                 GNOMON_PLACE(RayStd, light_at_infinity), GNOMON_PLACE_OF_VECTOR(RayStd, eye),
                 GNOMON_PLACE(RayStd, eye_at_infinity), GNOMON_PLACE(RayStd, masked), GNOMON_PLACE(RayStd, material_of),
                 GNOMON_PLACE(RayStd, materials), GNOMON_PLACE(RayStd, textures), GNOMON_PLACE(RayStd, corner_uv)});
    for (backend::Kernel const* const kernel : {&pipeline::shadow_lookup_kernel, &pipeline::ray_kernel}) {
        auto const interface = vulkan::reflect(kernel->spirv, kernel->name);
        REQUIRE(interface);
        CHECK(interface->constant_bytes == kernel->constant_bytes);
        CHECK(interface->bindings.size() == kernel->buffers + kernel->targets);
        CHECK(interface->local_size[0] == backend::kernel_local_size);
    }
}
