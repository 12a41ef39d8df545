#pragma once
// A small glTF file with everything that moves: a skinned mesh, a morphed one with a sparse target, clips of all paths and
// interpolations, a camera and a light on an animated node.

#include "gltf_fixture.hpp"

#include <string>
#include <vector>

namespace fixture {

/// Accessors put into one buffer, a view each.
class FileMaker {
public:
    /// returns: the accessor's index. `more` goes into its JSON: a comma first.
    int accessor(Blob const& data, int component_type, std::string const& type, std::size_t count, std::string const& more = "") {
        int const at = view(data);
        return plain(R"("bufferView":)" + std::to_string(at) + ",", component_type, type, count, more);
    }
    int plain(std::string const& begin, int component_type, std::string const& type, std::size_t count, std::string const& more) {
        accessors_ += (accessors_.empty() ? "{" : ",{") + begin + R"("componentType":)" + std::to_string(component_type) + R"(,"type":")" + type +
                      R"(","count":)" + std::to_string(count) + more + "}";
        return accessor_count_++;
    }
    int view(Blob const& data) {
        while (bytes_.size() % 4 != 0) bytes_.push_back(std::byte{0});
        views_ += (views_.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") + std::to_string(bytes_.size()) + R"(,"byteLength":)" +
                  std::to_string(data.size()) + "}";
        bytes_.insert(bytes_.end(), data.bytes().begin(), data.bytes().end());
        return view_count_++;
    }
    /// `json` is the root's members but for accessors, views and buffers.
    [[nodiscard]] std::vector<std::byte> file(std::string const& json) const {
        return glb(R"({"asset":{"version":"2.0"},)" + json + R"(,"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
                       R"(],"buffers":[{"byteLength":)" + std::to_string(bytes_.size()) + "}]}",
                   bytes_);
    }

private:
    std::string accessors_;
    std::string views_;
    std::vector<std::byte> bytes_;
    int accessor_count_ = 0;
    int view_count_ = 0;
};

inline std::string sampler(int input, int output, std::string const& interpolation) {
    return R"({"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(output) + R"(,"interpolation":")" + interpolation + R"("})";
}

inline std::string target(int sampler_index, int node, std::string const& path) {
    return R"({"sampler":)" + std::to_string(sampler_index) + R"(,"target":{"node":)" + std::to_string(node) + R"(,"path":")" + path + R"("}})";
}

/// Accessors 0 to 11, in the order of the comments.
inline FileMaker moving_data() {
    FileMaker f;
    auto const u8 = [](int v) { return static_cast<std::uint8_t>(v); };
    auto const i16 = [](int v) { return static_cast<std::int16_t>(v); };
    f.accessor(Blob().add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F), 5126, "VEC3", 4);  // 0 positions
    Blob indices;
    for (int i : {0, 1, 2, 0, 2, 3}) indices.add(static_cast<std::uint16_t>(i));
    f.accessor(indices, 5123, "SCALAR", 6);  // 1
    Blob joints;
    Blob weights;
    for (int v = 0; v < 4; ++v) {
        joints.add(u8(0), u8(1), u8(v == 3 ? 200 : 0), u8(0));
        weights.add(u8(v < 2 ? 255 : 51), u8(v < 2 ? 0 : 204), u8(0), u8(0));
    }
    f.accessor(joints, 5121, "VEC4", 4);                        // 2: the 200 has weight 0
    f.accessor(weights, 5121, "VEC4", 4, R"(,"normalized":true)");  // 3
    Blob bind;
    for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 16; ++k) bind.add(k % 5 == 0 ? 1.0F : k == 13 && j == 1 ? -1.0F : 0.0F);
    f.accessor(bind, 5126, "MAT4", 2);  // 4
    f.accessor(Blob().add(0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 2.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F, 4.0F), 5126, "VEC3", 4);  // 5 offsets
    int const index_view = f.view(Blob().add(std::uint16_t{2}, std::uint16_t{0}));
    int const value_view = f.view(Blob().add(-1.0F, 0.0F, 0.0F));
    f.plain("", 5126, "VEC3", 4, R"(,"sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(index_view) +
                R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(value_view) + "}}");  // 6 sparse offsets
    f.accessor(Blob().add(0.5F, 1.0F, 3.0F), 5126, "SCALAR", 3);                                             // 7 times
    f.accessor(Blob().add(0.0F, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F, 4.0F, 2.0F, 0.0F), 5126, "VEC3", 3);           // 8 translations
    Blob spline;
    for (int k = 0; k < 3; ++k) spline.add(0.0F, 0.0F, 0.1F, 0.0F, 0.0F, 0.0F, k == 1 ? 1.0F : 0.0F, k == 1 ? 0.0F : 1.0F, 0.0F, 0.0F, -0.1F, 0.0F);
    f.accessor(spline, 5126, "VEC4", 9);                                             // 9 rotations, cubic
    f.accessor(Blob().add(0.0F, 1.0F, 0.5F, 0.25F, 1.0F, 0.0F), 5126, "SCALAR", 6);  // 10 weights
    Blob turns;
    for (int k = 0; k < 3; ++k) turns.add(i16(0), i16(k == 1 ? 32767 : 0), i16(0), i16(k == 1 ? 0 : 32767));
    f.accessor(turns, 5122, "VEC4", 3, R"(,"normalized":true)");  // 11 rotations, shorts
    return f;
}

/// Nodes: 0 the skinned mesh, 1 and 2 its joints, 3 the morphed mesh on 4, which also holds camera 5 and light 6.
inline std::string moving_json() {
    return R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)"
           R"("scene":0,"scenes":[{"name":"all","nodes":[0,1,4]},{"name":"prop","nodes":[4]}],"cameras":[{"type":"perspective","perspective":{"yfov":1.0,"znear":0.1}}],)"
           R"("nodes":[{"name":"body","mesh":0,"skin":0,"translation":[100,0,0]},{"name":"root","children":[2]},{"name":"tip","translation":[0,1,0]},)"
           R"({"name":"prop","mesh":1,"translation":[0,0,5],"weights":[0.5,0.0]},{"name":"arm","children":[3,5,6],"translation":[10,0,0]},)"
           R"({"name":"eye","camera":0,"translation":[0,0,1]},{"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}},"translation":[1,0,0]}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]},)"
           R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":5},{"POSITION":6}]}],"weights":[0.0,0.25]}],)"
           R"("skins":[{"name":"s","inverseBindMatrices":4,"joints":[1,2]}],"animations":[{"name":"first","samplers":[)" +
           sampler(7, 8, "LINEAR") + "," + sampler(7, 9, "CUBICSPLINE") + "," + sampler(7, 10, "STEP") + "," + sampler(7, 11, "LINEAR") +
           R"(],"channels":[)" + target(0, 1, "translation") + "," + target(1, 2, "rotation") + "," + target(2, 3, "weights") + "," +
           target(3, 4, "rotation") + R"(]},{"name":"second","samplers":[)" + sampler(7, 8, "STEP") + R"(],"channels":[)" +
           target(0, 4, "scale") + "]}]";
}

inline std::vector<std::byte> moving_file() { return moving_data().file(moving_json()); }

}  // namespace fixture
