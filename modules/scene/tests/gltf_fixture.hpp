#pragma once
// Small glTF files for the tests, put together in memory.

#include <gnomon/scene/load.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fixture {

using namespace gnomon;

/// Bytes of plain numbers, one after the other.
class Blob {
public:
    template <class T, class... Rest>
    Blob& add(T first, Rest... rest) {
        std::size_t const at = bytes_.size();
        bytes_.resize(at + sizeof(T));
        std::memcpy(bytes_.data() + at, &first, sizeof(T));
        if constexpr (sizeof...(rest) != 0) add(rest...);
        return *this;
    }
    Blob& pad_to(std::size_t size) {
        bytes_.resize(size);
        return *this;
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    [[nodiscard]] std::vector<std::byte> const& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

inline void append_u32(std::vector<std::byte>& out, std::uint64_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>((value >> shift) & 0xFFU));
}

inline void append_text(std::vector<std::byte>& out, std::string_view text) {
    for (char c : text) out.push_back(static_cast<std::byte>(c));
}

/// A GLB file; without `bin`, if that is empty, its second chunk.
inline std::vector<std::byte> glb(std::string json, std::vector<std::byte> bin) {
    while (json.size() % 4 != 0) json += ' ';
    while (bin.size() % 4 != 0) bin.push_back(std::byte{0});
    std::vector<std::byte> out;
    append_text(out, "glTF");
    append_u32(out, 2);
    append_u32(out, 20 + json.size() + (bin.empty() ? 0 : 8 + bin.size()));
    append_u32(out, json.size());
    append_u32(out, 0x4E4F534A);
    append_text(out, json);
    if (bin.empty()) return out;
    append_u32(out, bin.size());
    append_u32(out, 0x004E4942);
    out.insert(out.end(), bin.begin(), bin.end());
    return out;
}

inline std::vector<std::byte> text(std::string_view json) {
    std::vector<std::byte> out;
    append_text(out, json);
    return out;
}

/// `original` with the first `from` replaced by `to`.
inline std::string replaced(std::string original, std::string_view from, std::string_view to) {
    std::size_t const at = original.find(from);
    if (at == std::string::npos) return "the test replaces nothing: " + std::string(from);
    return original.replace(at, from.size(), to);
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) with normals +z and texture coordinates: the file that most tests start from.
inline std::string triangle_json() {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"name":"s","nodes":[0]}],)"
           R"("nodes":[{"name":"n","mesh":0,"translation":[1,2,3]}],)"
           R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],)"
           R"("materials":[{"name":"paint"}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},)"
           R"({"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"}],)"
           R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},)"
           R"({"buffer":0,"byteOffset":72,"byteLength":24},{"buffer":0,"byteOffset":96,"byteLength":6}],)"
           R"("buffers":[{"byteLength":104}]})";
}

inline Blob triangle_blob() {
    Blob blob;
    blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F);
    blob.add(0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F);
    blob.add(0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F);
    blob.add(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2}).pad_to(104);
    return blob;
}

inline scene::Result<scene::Scene> load(std::vector<std::byte> const& file, scene::LoadConfig const& config = {}) {
    return scene::load_gltf_bytes(file, "", config);
}

/// The triangle file with one change in its JSON.
inline scene::Result<scene::Scene> load_changed(std::string_view from, std::string_view to) {
    return load(glb(replaced(triangle_json(), from, to), triangle_blob().bytes()));
}

/// A scene of one mesh with one primitive, given its parts.
inline std::vector<std::byte> one_primitive(std::string const& primitive, std::string const& accessors,
                                            std::string const& views, Blob const& blob) {
    std::string const json = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitive +
                             R"(]}],"accessors":[)" + accessors + R"(],"bufferViews":[)" + views +
                             R"(],"buffers":[{"byteLength":)" + std::to_string(blob.size()) + "}]}";
    return glb(json, blob.bytes());
}

/// A folder of its own that goes away with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::filesystem::path const base = std::filesystem::temp_directory_path();
        for (int i = 0; path_.empty(); ++i) {
            std::filesystem::path const candidate = base / ("gnomon-scene-" + std::to_string(i));
            std::error_code error;
            if (std::filesystem::create_directory(candidate, error)) path_ = candidate;
        }
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string operator/(std::string const& name) const { return (path_ / name).string(); }

    void save(std::string const& name, std::vector<std::byte> const& bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream out(path_ / name, std::ios::binary);
        out.write(reinterpret_cast<char const*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

    [[nodiscard]] std::size_t file_count() const {
        std::size_t count = 0;
        for (auto const& entry : std::filesystem::directory_iterator(path_)) count += entry.exists() ? 1U : 0U;
        return count;
    }

private:
    std::filesystem::path path_;
};

}  // namespace fixture
