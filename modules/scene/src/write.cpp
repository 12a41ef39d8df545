#include <gnomon/scene/write.hpp>

#include "detail/failure.hpp"
#include "detail/file_bytes.hpp"
#include "detail/image_codec.hpp"
#include "detail/json_writer.hpp"

#include <gnomon/math/bounds.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gnomon::scene {

namespace {

using detail::Bytes;
using detail::fail;
using detail::JsonWriter;

constexpr std::uint64_t gltf_unsigned_short = 5123;
constexpr std::uint64_t gltf_unsigned_int = 5125;
constexpr std::uint64_t gltf_float = 5126;
constexpr std::uint64_t target_vertices = 34962;
constexpr std::uint64_t target_indices = 34963;

char const* name_of(AlphaMode mode) noexcept {
    switch (mode) {
        case AlphaMode::opaque: return "OPAQUE";
        case AlphaMode::mask: return "MASK";
        case AlphaMode::blend: return "BLEND";
    }
    return "OPAQUE";
}

char const* name_of(AnimationPath path) noexcept {
    switch (path) {
        case AnimationPath::translation: return "translation";
        case AnimationPath::rotation: return "rotation";
        case AnimationPath::scale: return "scale";
        case AnimationPath::weights: return "weights";
    }
    return "translation";
}

char const* name_of(Interpolation interpolation) noexcept {
    switch (interpolation) {
        case Interpolation::step: return "STEP";
        case Interpolation::linear: return "LINEAR";
        case Interpolation::cubic_spline: return "CUBICSPLINE";
    }
    return "LINEAR";
}

std::uint64_t wrap_code(math::Wrap wrap) noexcept {
    switch (wrap) {
        case math::Wrap::repeat: return 10497;
        case math::Wrap::clamp: return 33071;
        case math::Wrap::mirror: return 33648;
    }
    return 10497;
}

template <class V>
void write_vector(JsonWriter& json, V const& v, int count) {
    json.begin_array();
    for (int i = 0; i < count; ++i) json.value(static_cast<double>(v[i]));
    json.end_array();
}

/// The binary part of a file, with the views and accessors that describe it.
class BufferWriter {
public:
    Bytes bytes;

    std::uint64_t add_view(void const* data, std::size_t size, std::uint64_t target) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        std::size_t const offset = bytes.size();
        bytes.resize(offset + size);
        if (size != 0) std::memcpy(bytes.data() + offset, data, size);
        views_.begin_object().member("buffer", std::uint64_t{0}).member("byteOffset", std::uint64_t{offset});
        views_.member("byteLength", std::uint64_t{size});
        if (target != 0) views_.member("target", target);
        views_.end_object();
        return view_count_++;
    }

    /// One of the two sets of four that a vertex's joints and their weights are stored in.
    template <class T>
    std::uint64_t add_influences(std::vector<T> const& values, std::uint32_t per_vertex, std::uint32_t set) {
        std::vector<T> four;
        four.reserve(values.size() / per_vertex * 4);
        for (std::size_t k = set * std::size_t{4}; k < values.size(); k += per_vertex)
            for (std::size_t c = 0; c < 4; ++c) four.push_back(values[k + c]);
        bool const joints = sizeof(T) == sizeof(std::uint16_t);
        begin_accessor(four, joints ? gltf_unsigned_short : gltf_float, "VEC4", target_vertices, four.size() / 4);
        return end_accessor();
    }

    /// Floats that no vertex owns: `count` elements of `type`.
    std::uint64_t add_floats(std::vector<float> const& values, char const* type, std::size_t count) {
        begin_accessor(values, gltf_float, type, 0, count);
        return end_accessor();
    }

    std::uint64_t add_matrices(std::vector<math::mat4> const& matrices) {
        begin_accessor(matrices, gltf_float, "MAT4", 0, matrices.size());
        return end_accessor();
    }

    /// Key times, with the first and last as glTF wants them.
    std::uint64_t add_times(std::vector<float> const& times_s) {
        begin_accessor(times_s, gltf_float, "SCALAR", 0, times_s.size());
        accessors_.key("min").begin_array().value(static_cast<double>(times_s.front())).end_array();
        accessors_.key("max").begin_array().value(static_cast<double>(times_s.back())).end_array();
        return end_accessor();
    }

    template <class T>
    std::uint64_t add_vectors(std::vector<T> const& values, char const* type) {
        begin_accessor(values, gltf_float, type, target_vertices, values.size());
        return end_accessor();
    }

    std::uint64_t add_positions(std::vector<math::vec3> const& positions) {
        begin_accessor(positions, gltf_float, "VEC3", target_vertices, positions.size());
        math::Aabb const box = math::bounds_of(positions);
        if (math::is_empty(box)) return end_accessor();
        accessors_.key("min");
        write_vector(accessors_, box.lo, 3);
        accessors_.key("max");
        write_vector(accessors_, box.hi, 3);
        return end_accessor();
    }

    std::uint64_t add_indices(std::vector<std::uint32_t> const& indices) {
        begin_accessor(indices, gltf_unsigned_int, "SCALAR", target_indices, indices.size());
        return end_accessor();
    }

    void write(JsonWriter& json) {
        json.key("bufferViews").begin_array();
        json.text += views_.text;
        json.end_array().key("accessors").begin_array();
        json.text += accessors_.text;
        json.end_array();
    }

private:
    template <class T>
    void begin_accessor(std::vector<T> const& values, std::uint64_t component, char const* type, std::uint64_t target, std::size_t count) {
        std::uint64_t const view = add_view(values.data(), values.size() * sizeof(T), target);
        accessors_.begin_object().member("bufferView", view).member("componentType", component);
        accessors_.member("count", std::uint64_t{count}).member("type", type);
    }

    std::uint64_t end_accessor() {
        accessors_.end_object();
        return accessor_count_++;
    }

    JsonWriter views_;
    JsonWriter accessors_;
    std::uint64_t view_count_ = 0;
    std::uint64_t accessor_count_ = 0;
};

class SceneWriter {
public:
    explicit SceneWriter(Scene const& scene) : scene_(scene) {}

    /// The JSON but for `buffers` and the closing bracket.
    void run() {
        json_.begin_object().key("asset").begin_object();
        json_.member("version", "2.0").member("generator", "gnomon").end_object();
        write_extensions();
        write_images();
        write_materials();
        write_meshes();
        write_cameras();
        write_lights();
        write_nodes();
        write_skins();
        write_animations();
        buffer.write(json_);
    }

    std::string finish(std::string const& uri) {
        json_.key("buffers").begin_array().begin_object().member("byteLength", std::uint64_t{buffer.bytes.size()});
        if (!uri.empty()) json_.member("uri", uri);
        json_.end_object().end_array().end_object();
        return std::move(json_.text);
    }

    BufferWriter buffer;

private:
    [[nodiscard]] bool has_transforms() const {
        return std::any_of(scene_.materials.begin(), scene_.materials.end(),
                           [](Material const& m) { return is_transformed(m.base_color_texture); });
    }

    static bool is_transformed(TextureUse const& use) {
        return use.offset != math::vec2(0.0F) || use.scale != math::vec2(1.0F) || use.rotation_rad != 0.0F;
    }

    void write_extensions() {
        if (scene_.lights.empty() && !has_transforms()) return;
        json_.key("extensionsUsed").begin_array();
        if (!scene_.lights.empty()) json_.value("KHR_lights_punctual");
        if (has_transforms()) json_.value("KHR_texture_transform");
        json_.end_array();
    }

    void write_name(std::string const& name) {
        if (!name.empty()) json_.member("name", name);
    }

    void write_images() {
        if (scene_.images.empty()) return;
        json_.key("images").begin_array();
        for (Image const& image : scene_.images) {
            auto const png = detail::encode_png(image);
            if (!png) fail(SceneError::not_writable, "image " + detail::quoted(image.name) + " does not fit into memory as PNG");
            json_.begin_object();
            write_name(image.name);
            json_.member("mimeType", "image/png").member("bufferView", buffer.add_view(png->data(), png->size(), 0));
            json_.end_object();
        }
        json_.end_array();
        if (scene_.textures.empty()) return;
        json_.key("samplers").begin_array();
        for (Texture const& t : scene_.textures) {
            json_.begin_object().member("wrapS", wrap_code(t.wrap_u)).member("wrapT", wrap_code(t.wrap_v));
            json_.member("magFilter", std::uint64_t{t.nearest ? 9728U : 9729U}).end_object();
        }
        json_.end_array().key("textures").begin_array();
        for (std::uint64_t i = 0; i < scene_.textures.size(); ++i)
            json_.begin_object().member("source", std::uint64_t{scene_.textures[i].image}).member("sampler", i).end_object();
        json_.end_array();
    }

    void write_texture_use(TextureUse const& use) {
        json_.begin_object().member("index", std::uint64_t{use.texture}).member("texCoord", std::uint64_t{use.uv_set});
        if (is_transformed(use)) {
            json_.key("extensions").begin_object().key("KHR_texture_transform").begin_object().key("offset");
            write_vector(json_, use.offset, 2);
            json_.key("scale");
            write_vector(json_, use.scale, 2);
            json_.member("rotation", static_cast<double>(use.rotation_rad)).end_object().end_object();
        }
        json_.end_object();
    }

    void write_materials() {
        if (scene_.materials.empty()) return;
        json_.key("materials").begin_array();
        for (Material const& m : scene_.materials) {
            json_.begin_object();
            write_name(m.name);
            json_.key("pbrMetallicRoughness").begin_object().key("baseColorFactor");
            write_vector(json_, m.base_color, 4);
            if (m.base_color_texture.texture != none) {
                json_.key("baseColorTexture");
                write_texture_use(m.base_color_texture);
            }
            json_.member("metallicFactor", static_cast<double>(m.metallic));
            json_.member("roughnessFactor", static_cast<double>(m.roughness)).end_object();
            json_.key("emissiveFactor");
            write_vector(json_, m.emissive, 3);
            json_.member("alphaMode", name_of(m.alpha_mode)).member("doubleSided", m.double_sided);
            json_.member("alphaCutoff", static_cast<double>(m.alpha_cutoff)).end_object();
        }
        json_.end_array();
    }

    void write_meshes() {
        if (scene_.meshes.empty()) return;
        json_.key("meshes").begin_array();
        for (Mesh const& mesh : scene_.meshes) {
            json_.begin_object();
            write_name(mesh.name);
            json_.key("primitives").begin_array();
            for (Primitive const& p : mesh.primitives) write_primitive(p);
            json_.end_array();
            write_weights(mesh.weights);
            json_.end_object();
        }
        json_.end_array();
    }

    void write_primitive(Primitive const& p) {
        json_.begin_object().key("attributes").begin_object();
        json_.member("POSITION", buffer.add_positions(p.positions)).member("NORMAL", buffer.add_vectors(p.normals, "VEC3"));
        if (!p.uv0.empty()) json_.member("TEXCOORD_0", buffer.add_vectors(p.uv0, "VEC2"));
        if (!p.uv1.empty()) json_.member("TEXCOORD_1", buffer.add_vectors(p.uv1, "VEC2"));
        for (std::uint32_t set = 0; set * 4 < p.influences; ++set) {
            json_.member("JOINTS_" + std::to_string(set), buffer.add_influences(p.joints, p.influences, set));
            json_.member("WEIGHTS_" + std::to_string(set), buffer.add_influences(p.joint_weights, p.influences, set));
        }
        json_.end_object().member("indices", buffer.add_indices(p.indices)).member("material", std::uint64_t{p.material});
        if (!p.morph_targets.empty()) json_.key("targets").begin_array();
        for (MorphTarget const& target : p.morph_targets) {
            json_.begin_object();
            if (!target.positions.empty()) json_.member("POSITION", buffer.add_positions(target.positions));
            if (!target.normals.empty()) json_.member("NORMAL", buffer.add_vectors(target.normals, "VEC3"));
            json_.end_object();
        }
        if (!p.morph_targets.empty()) json_.end_array();
        json_.end_object();
    }

    void write_weights(std::vector<float> const& weights) {
        if (weights.empty()) return;
        json_.key("weights").begin_array();
        for (float const weight : weights) json_.value(static_cast<double>(weight));
        json_.end_array();
    }

    void write_cameras() {
        if (scene_.cameras.empty()) return;
        json_.key("cameras").begin_array();
        for (Camera const& c : scene_.cameras) {
            bool const perspective = c.kind == CameraKind::perspective;
            json_.begin_object();
            write_name(c.name);
            json_.member("type", perspective ? "perspective" : "orthographic");
            json_.key(perspective ? "perspective" : "orthographic").begin_object().member("znear", c.near_m);
            if (std::isfinite(c.far_m)) json_.member("zfar", c.far_m);
            if (perspective)
                json_.member("yfov", c.fov_y_rad);
            else
                json_.member("xmag", c.half_width_m).member("ymag", c.half_height_m);
            json_.end_object().end_object();
        }
        json_.end_array();
    }

    void write_lights() {
        if (scene_.lights.empty()) return;
        json_.key("extensions").begin_object().key("KHR_lights_punctual").begin_object().key("lights").begin_array();
        for (Light const& l : scene_.lights) {
            json_.begin_object();
            write_name(l.name);
            json_.member("type", l.kind == LightKind::directional ? "directional" : l.kind == LightKind::point ? "point" : "spot");
            json_.key("color");
            write_vector(json_, l.color, 3);
            json_.member("intensity", static_cast<double>(l.intensity));
            if (std::isfinite(l.range_m)) json_.member("range", static_cast<double>(l.range_m));
            if (l.kind == LightKind::spot)
                json_.key("spot").begin_object().member("innerConeAngle", static_cast<double>(l.inner_cone_rad))
                    .member("outerConeAngle", static_cast<double>(l.outer_cone_rad)).end_object();
            json_.end_object();
        }
        json_.end_array().end_object().end_object();
    }

    void begin_node(std::string const& name, math::dmat4 const& world) {
        json_.begin_object();
        write_name(name);
        if (world != math::dmat4(1.0)) write_matrix(world);
    }

    void write_matrix(math::dmat4 const& m) {
        json_.key("matrix").begin_array();
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row) json_.value(m[column][row]);
        json_.end_array();
    }

    static math::dmat4 posed(math::dvec3 const& x, math::dvec3 const& y, math::dvec3 const& z, math::dvec3 const& at) {
        math::dmat4 m(1.0);
        for (int row = 0; row < 3; ++row) {
            m[0][row] = x[row];
            m[1][row] = y[row];
            m[2][row] = z[row];
            m[3][row] = at[row];
        }
        return m;
    }

    /// The scene's own nodes first, then one for each instance, camera and light, so that all come back in their order.
    void write_nodes() {
        std::uint64_t const first_instance = scene_.nodes.size();
        std::uint64_t const first_camera = first_instance + scene_.instances.size();
        std::uint64_t const first_light = first_camera + scene_.cameras.size();
        children_.assign(scene_.nodes.size(), {});
        for (std::uint64_t i = 0; i < scene_.nodes.size(); ++i) hang(i, scene_.nodes[i].parent);
        for (std::uint64_t i = 0; i < scene_.instances.size(); ++i) hang(first_instance + i, scene_.instances[i].node);
        for (std::uint64_t i = 0; i < scene_.cameras.size(); ++i) hang(first_camera + i, scene_.cameras[i].node);
        for (std::uint64_t i = 0; i < scene_.lights.size(); ++i) hang(first_light + i, scene_.lights[i].node);
        json_.key("nodes").begin_array();
        for (std::uint64_t i = 0; i < scene_.nodes.size(); ++i) write_own_node(scene_.nodes[i], children_[i]);
        for (Instance const& instance : scene_.instances) write_instance(instance);
        for (std::uint64_t i = 0; i < scene_.cameras.size(); ++i) {
            Camera const& c = scene_.cameras[i];
            begin_node(c.name, c.node != none ? c.node_from_camera : posed(c.right, c.up, c.back, c.eye_m));
            json_.member("camera", i).end_object();
        }
        for (std::uint64_t i = 0; i < scene_.lights.size(); ++i) {
            Light const& l = scene_.lights[i];
            // A light has no up: the axes beside its direction are those of any camera that looks along it.
            Camera const frame = looking_at("", math::dvec3(0.0), l.direction, 1.0);
            begin_node(l.name, l.node != none ? l.node_from_light : posed(frame.right, frame.up, -l.direction, l.position_m));
            json_.key("extensions").begin_object().key("KHR_lights_punctual").begin_object().member("light", i);
            json_.end_object().end_object().end_object();
        }
        json_.end_array().key("scenes").begin_array().begin_object();
        write_name(scene_.name);
        write_list("nodes", roots_);
        json_.end_object().end_array().member("scene", std::uint64_t{0});
    }

    void hang(std::uint64_t node, std::uint32_t parent) {
        (parent == none ? roots_ : children_[parent]).push_back(node);
    }

    void write_list(char const* name, std::vector<std::uint64_t> const& list) {
        json_.key(name).begin_array();
        for (std::uint64_t const i : list) json_.value(i);
        json_.end_array();
    }

    void write_own_node(Node const& node, std::vector<std::uint64_t> const& children) {
        json_.begin_object();
        write_name(node.name);
        if (node.matrix) {
            write_matrix(*node.matrix);
        } else {
            if (node.translation != math::dvec3(0.0)) {
                json_.key("translation");
                write_vector(json_, node.translation, 3);
            }
            if (node.rotation != math::dvec4(0.0, 0.0, 0.0, 1.0)) {
                json_.key("rotation");
                write_vector(json_, node.rotation, 4);
            }
            if (node.scale != math::dvec3(1.0)) {
                json_.key("scale");
                write_vector(json_, node.scale, 3);
            }
        }
        if (!children.empty()) write_list("children", children);
        // So that it comes back as a node, whether anything moves it or not.
        json_.key("extras").begin_object().member("gnomon_node", true).end_object().end_object();
    }

    void write_instance(Instance const& instance) {
        begin_node(instance.name, instance.node != none ? instance.node_from_mesh : instance.world_from_mesh);
        json_.member("mesh", std::uint64_t{instance.mesh});
        if (instance.skin != none) json_.member("skin", std::uint64_t{instance.skin});
        write_weights(instance.weights);
        json_.end_object();
    }

    void write_skins() {
        if (scene_.skins.empty()) return;
        json_.key("skins").begin_array();
        for (Skin const& skin : scene_.skins) {
            json_.begin_object();
            write_name(skin.name);
            json_.member("inverseBindMatrices", buffer.add_matrices(skin.inverse_bind));
            write_list("joints", {skin.joints.begin(), skin.joints.end()});
            json_.end_object();
        }
        json_.end_array();
    }

    void write_animations() {
        auto const plays = [](Animation const& a) { return !a.channels.empty(); };
        if (std::none_of(scene_.animations.begin(), scene_.animations.end(), plays)) return;
        json_.key("animations").begin_array();
        for (Animation const& animation : scene_.animations) {
            if (!plays(animation)) continue;
            json_.begin_object();
            write_name(animation.name);
            json_.key("samplers").begin_array();
            for (AnimationChannel const& channel : animation.channels) write_sampler(channel);
            json_.end_array().key("channels").begin_array();
            for (std::uint64_t c = 0; c < animation.channels.size(); ++c) {
                AnimationChannel const& channel = animation.channels[c];
                bool const weights = channel.path == AnimationPath::weights;
                std::uint64_t const node = weights ? scene_.nodes.size() + channel.instance : channel.node;
                json_.begin_object().member("sampler", c).key("target").begin_object().member("node", node);
                json_.member("path", name_of(channel.path)).end_object().end_object();
            }
            json_.end_array().end_object();
        }
        json_.end_array();
    }

    void write_sampler(AnimationChannel const& channel) {
        std::uint32_t const width = components_of(channel.path);
        char const* const type = width == 0 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
        json_.begin_object().member("input", buffer.add_times(channel.times_s));
        json_.member("output", buffer.add_floats(channel.values, type, channel.values.size() / std::max(width, 1U)));
        json_.member("interpolation", name_of(channel.interpolation)).end_object();
    }

    std::vector<std::vector<std::uint64_t>> children_;  ///< Per node of the scene, indices of the file's nodes.
    std::vector<std::uint64_t> roots_;
    Scene const& scene_;
    JsonWriter json_;
};

void append_u32(std::string& out, std::uint64_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>((value >> shift) & 0xFFU);
}

std::string glb_file(SceneWriter& writer) {
    Bytes const& data = writer.buffer.bytes;
    std::string json = writer.finish("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::uint64_t const padded = (data.size() + 3) / 4 * 4;
    std::uint64_t const length = 12 + 8 + json.size() + 8 + padded;
    if (length > 0xFFFF'FFFFU) fail(SceneError::over_limit, "the scene needs " + std::to_string(length) + " bytes and a GLB file holds 4 GiB; write fewer triangles");
    std::string file = "glTF";
    append_u32(file, 2);
    append_u32(file, length);
    append_u32(file, json.size());
    append_u32(file, 0x4E4F534A);
    file += json;
    append_u32(file, padded);
    append_u32(file, 0x004E4942);
    file.append(reinterpret_cast<char const*>(data.data()), data.size());
    file.resize(length, '\0');
    return file;
}

std::string gltf_file(SceneWriter& writer) {
    Bytes const& data = writer.buffer.bytes;
    return writer.finish("data:application/octet-stream;base64," + detail::encode_base64(data.data(), data.size()));
}

/// Removes the half-written file unless told that it is whole.
struct TemporaryFile {
    std::filesystem::path path;
    bool keep = false;
    TemporaryFile(TemporaryFile const&) = delete;
    TemporaryFile& operator=(TemporaryFile const&) = delete;
    explicit TemporaryFile(std::filesystem::path p) : path(std::move(p)) {}
    ~TemporaryFile() {
        std::error_code ignored;
        if (!keep) std::filesystem::remove(path, ignored);
    }
};

void save(std::string const& path, std::string const& file) {
    if (std::error_code error; std::filesystem::is_directory(path, error))
        fail(SceneError::not_writable, detail::quoted(path) + " is a folder; name a file in it");
    TemporaryFile temporary(path + ".part");
    std::ofstream out(temporary.path, std::ios::binary | std::ios::trunc);
    if (!out) {
        temporary.keep = true;
        fail(SceneError::not_writable, detail::quoted(path) + " cannot be written; check that its folder exists and may be written to");
    }
    out.write(file.data(), static_cast<std::streamsize>(file.size()));
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(temporary.path, path, error);
    if (!out || error)
        fail(SceneError::not_writable, detail::quoted(path) + " cannot be written whole (" + std::to_string(file.size()) +
                                           " bytes); check the space on its disk");
    temporary.keep = true;
}

}  // namespace

Result<core::Done> write_gltf(Scene const& scene, std::string const& path) {
    try {
        if (auto ok = validate(scene); !ok) return ok;
        bool const binary = path.ends_with(".glb");
        if (!binary && !path.ends_with(".gltf"))
            return core::Failure{SceneError::bad_config, detail::quoted(path) + " ends in neither .gltf nor .glb; name it so"};
        SceneWriter writer(scene);
        writer.run();
        save(path, binary ? glb_file(writer) : gltf_file(writer));
        return core::Done{};
    } catch (detail::LoadFailure const& caught) {
        return caught.failure;
    } catch (std::exception const& caught) {
        return core::Failure{SceneError::not_writable, detail::quoted(path) + " cannot be written (" + caught.what() + "); check the disk and memory"};
    }
}

}  // namespace gnomon::scene
