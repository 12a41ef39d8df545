// The verbs `draw_ortho` and `write_depth`: passes in whole units, and depths from kernels.

#include <gnomon/vulkan/backend.hpp>

#include <string>

namespace gnomon::vulkan {

backend::Result<backend::PassCounts> Backend::draw_ortho(backend::DrawListId, backend::TargetId,
                                                         std::span<backend::OrthoLayer const>) {
    return core::Failure{backend::Error::missing_feature, std::string("draw_ortho: not on this backend yet")};
}

backend::Result<core::Done> Backend::write_depth(backend::DepthKernel const&, backend::DepthCall const&) {
    return core::Failure{backend::Error::missing_feature, std::string("write_depth: not on this backend yet")};
}

}  // namespace gnomon::vulkan
