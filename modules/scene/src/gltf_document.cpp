#include "detail/gltf_document.hpp"

#include "detail/json_scan.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::scene::detail {

namespace {

constexpr std::array<std::string_view, 4> read_extensions{"KHR_mesh_quantization", "KHR_texture_transform",
                                                          "KHR_lights_punctual", "EXT_mesh_gpu_instancing"};

/// Extensions that only change how a surface shines leave the geometry as it is; all but their colours can be left out.
bool is_shading_only(std::string_view name) noexcept {
    return name.starts_with("KHR_materials_") || name == "KHR_technique_webgl" || name == "KHR_techniques_webgl";
}

std::uint32_t little_endian_u32(std::span<std::byte const> bytes, std::size_t at) noexcept {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

std::string_view as_text(std::span<std::byte const> bytes) noexcept {
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

/// The parser's complaint as the end of a sentence.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text.substr(0, 200);
}

bool refuse_file(std::string const&, void*) { return false; }
std::string same_path(std::string const& path, void*) { return path; }
bool refuse_read(std::vector<unsigned char>*, std::string*, std::string const&, void*) { return false; }
bool refuse_write(std::string*, std::string const&, std::vector<unsigned char> const&, void*) { return false; }

}  // namespace

Document::Document(std::span<std::byte const> file, std::string base_dir, LoadConfig const& config_in)
    : config(config_in), base_dir_(std::move(base_dir)), bytes_left_(config_in.limits.max_file_bytes) {
    if (file.size() > bytes_left_)
        fail(SceneError::over_limit, "the file is " + std::to_string(file.size()) + " bytes, above the limit of " +
                                         std::to_string(bytes_left_) + "; simplify it or raise max_file_bytes");
    bytes_left_ -= file.size();
    if (file.empty()) fail(SceneError::not_gltf, "the file is empty; give a .gltf or .glb file");
    if (as_text(file).starts_with("glTF"))
        split_glb(file);
    else
        json_ = as_text(file);
    if (!has_glb_bytes_ && json_.find_first_not_of("\xEF\xBB\xBF \t\r\n") != json_.find('{'))
        fail(SceneError::not_gltf, "the file begins with " + quoted(json_.substr(0, 16)) +
                                       ", which is neither JSON nor GLB; give a .gltf or .glb file");
    parse(json_);
}

void Document::split_glb(std::span<std::byte const> file) {
    auto const truncated = [&](std::uint64_t wanted) {
        fail(SceneError::malformed, "the GLB file has " + std::to_string(file.size()) + " bytes and says it has " +
                                        std::to_string(wanted) + "; it is cut off, so copy or export it again");
    };
    if (file.size() < 12) truncated(12);
    std::uint32_t const version = little_endian_u32(file, 4);
    if (version != 2)
        fail(SceneError::not_gltf, "the GLB file is of version " + std::to_string(version) + "; export it as version 2");
    std::uint64_t const length = little_endian_u32(file, 8);
    if (length > file.size()) truncated(length);
    if (length < 20) fail(SceneError::malformed, "the GLB file says it has " + std::to_string(length) + " bytes; 20 is the least");
    constexpr std::uint32_t json_type = 0x4E4F534A;
    constexpr std::uint32_t bin_type = 0x004E4942;
    bool first = true;
    for (std::uint64_t at = 12; at < length; first = false) {
        if (length - at < 8) truncated(at + 8);
        std::uint64_t const size = little_endian_u32(file, at);
        std::uint32_t const type = little_endian_u32(file, at + 4);
        at += 8;
        if (size > length - at) truncated(at + size);
        if (first && type != json_type)
            fail(SceneError::malformed, "the GLB file's first chunk is of type " + std::to_string(type) +
                                            " and not JSON; export it again");
        if (first) json_ = as_text(file.subspan(at, size));
        if (type == bin_type && !has_glb_bytes_) {
            glb_bytes_ = file.subspan(at, size);
            has_glb_bytes_ = true;
        }
        at += (size + 3) / 4 * 4;
    }
}

void Document::parse(std::string_view json) {
    ScannedJson const scanned = scan_json(json, config.limits);
    if (scanned.text.size() > 0xFFFF'FFFFU) fail(SceneError::over_limit, "the JSON is above 4 GiB; keep the data in buffers");
    tinygltf::TinyGLTF parser;
    tinygltf::FsCallbacks files{};
    files.FileExists = refuse_file;
    files.ExpandFilePath = same_path;
    files.ReadWholeFile = refuse_read;
    files.WriteWholeFile = refuse_write;
    parser.SetFsCallbacks(files);
    parser.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, unsigned char const*, int,
                             void*) { return true; },
                          nullptr);
    std::string error;
    std::string warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, scanned.text.data(),
                                    static_cast<unsigned int>(scanned.text.size()), "")) {
        check_extensions();  // a better reason than the parser's, which trips over what an extension leaves out
        fail(SceneError::malformed, "the file is not valid glTF (" + one_line(error) + "); export it again");
    }
    if (!model.asset.version.starts_with("2."))
        fail(SceneError::not_gltf, "the file is glTF " + quoted(model.asset.version) + "; export it as version 2.0");
    // A channel without a node moves nothing that is read here; the parser leaves it out with this complaint.
    for (std::size_t at = 0; (at = error.find("field is missing in animation.channels", at)) != std::string::npos; ++at)
        ++notes.dropped_channels;
    check_extensions();
    static tinygltf::Value const nothing;
    tinygltf::Value const* const buffers = member(model.extras, "buffers");
    tinygltf::Value const* const sources = member(model.extras, "images");
    list_images(sources != nullptr ? *sources : nothing);
    load_buffers(buffers != nullptr ? *buffers : nothing);
}

void Document::check_extensions() {
    for (std::string const& name : model.extensionsRequired) {
        bool const read = std::find(read_extensions.begin(), read_extensions.end(), name) != read_extensions.end();
        if (!read && !is_shading_only(name))
            fail(SceneError::unsupported_extension, "the file requires the extension " + quoted(name) +
                                                        ", which is not read here; export it without that");
        if (!read) warn("The extension " + quoted(name) + " is left out: surfaces may look plainer.");
    }
}

void Document::list_images(tinygltf::Value const& list) {
    for (std::size_t i = 1; i < list.ArrayLen(); ++i) {
        tinygltf::Value const& value = list.Get(static_cast<int>(i)).Get(1);
        ImageSource source;
        if (auto const* name = member(value, "name"); name != nullptr && name->IsString()) source.name = name->Get<std::string>();
        if (auto const* uri = member(value, "uri"); uri != nullptr && uri->IsString()) source.uri = uri->Get<std::string>();
        source.view = whole_or_none(member(value, "bufferView"));
        images.push_back(std::move(source));
    }
}

void Document::load_buffers(tinygltf::Value const& list) {
    for (std::size_t i = 1; i < list.ArrayLen(); ++i)
        buffers_.push_back(load_buffer(list.Get(static_cast<int>(i)).Get(1), i - 1));
}

Document::Buffer Document::load_buffer(tinygltf::Value const& value, std::uint64_t index) {
    std::uint32_t const length = whole_or_none(member(value, "byteLength"));
    if (length == none) fail(SceneError::malformed, item("buffer", index) + " has no byteLength; export the file again");
    tinygltf::Value const* const uri = member(value, "uri");
    Buffer buffer;
    if (uri != nullptr && uri->IsString()) {
        auto bytes = uri_bytes(uri->Get<std::string>());
        if (!bytes)
            fail(bytes.failure().code, item("buffer", index) + "'s URI " + quoted(uri->Get<std::string>()) + " " +
                                           bytes.failure().message);
        buffer.owned = std::move(bytes).value();
        buffer.bytes = buffer.owned;
    } else if (index == 0 && has_glb_bytes_) {
        buffer.bytes = glb_bytes_;
    } else {
        fail(SceneError::malformed, item("buffer", index) + " has neither a URI nor a GLB chunk; export the file again");
    }
    if (buffer.bytes.size() < length)
        fail(SceneError::malformed, item("buffer", index) + " holds " + std::to_string(buffer.bytes.size()) +
                                        " bytes and says it has " + std::to_string(length) +
                                        "; it is cut off, so copy or export it again");
    buffer.bytes = buffer.bytes.first(length);
    return buffer;
}

core::Result<Bytes, SceneError> Document::uri_bytes(std::string const& uri) {
    if (is_data_uri(uri)) {
        auto bytes = decode_data_uri(uri);
        if (!bytes) return core::Failure{SceneError::malformed, "is not clean base64; export the file again"};
        return std::move(*bytes);
    }
    auto const path = resolve_uri(uri, base_dir_);
    if (!path)
        return core::Failure{SceneError::malformed,
                             "does not lead to a file in or below the scene's own folder; put the file there"};
    auto bytes = read_file(*path, bytes_left_);
    if (!bytes) {
        bool const missing = bytes.failure().code == ReadError::not_found;
        bool const large = bytes.failure().code == ReadError::too_large;
        return core::Failure{missing ? SceneError::not_found : large ? SceneError::over_limit : SceneError::unreadable,
                             bytes.failure().message};
    }
    bytes_left_ -= bytes->size();
    return std::move(bytes).value();
}

std::span<std::byte const> Document::view_bytes(std::uint64_t view) const {
    if (view >= model.bufferViews.size())
        fail(SceneError::malformed, item("buffer view", view) + " is named and there are only " +
                                        std::to_string(model.bufferViews.size()) + "; export the file again");
    tinygltf::BufferView const& v = model.bufferViews[view];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= buffers_.size())
        fail(SceneError::malformed, item("buffer view", view) + " names buffer " + std::to_string(v.buffer) +
                                        " and there are only " + std::to_string(buffers_.size()) +
                                        "; export the file again");
    std::span<std::byte const> const buffer = buffers_[static_cast<std::size_t>(v.buffer)].bytes;
    if (v.byteOffset > buffer.size() || v.byteLength > buffer.size() - v.byteOffset)
        fail(SceneError::malformed, item("buffer view", view) + " covers " + std::to_string(v.byteLength) +
                                        " bytes from byte " + std::to_string(v.byteOffset) + " of a buffer of " +
                                        std::to_string(buffer.size()) + "; export the file again");
    return buffer.subspan(v.byteOffset, v.byteLength);
}

void Document::warn(std::string sentence) {
    if (notes.warnings.size() < config.limits.max_warnings) notes.warnings.push_back(std::move(sentence));
}

void Document::charge_motion(std::uint64_t count) {
    motion_ += count;
    if (motion_ > config.limits.max_motion_values)
        fail(SceneError::over_limit, "the clips, skins and morph weights hold more than " +
                                         std::to_string(config.limits.max_motion_values) +
                                         " numbers; simplify them or raise max_motion_values");
}

void Document::charge_elements(std::uint64_t count) {
    elements_ += count;
    if (elements_ > config.limits.max_vertices)
        fail(SceneError::over_limit, "the meshes have more than " + std::to_string(config.limits.max_vertices) +
                                         " vertices; simplify them or raise max_vertices");
}

}  // namespace gnomon::scene::detail
