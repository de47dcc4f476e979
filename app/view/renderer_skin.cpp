#include "app/view/renderer_skin.hpp"

#include <algorithm>

namespace tendril::app {
namespace {

enum Slot : GLuint { Position, Normal, Uv, Tint, Joints, Weights };

GLuint texture_of(glm::ivec2 size, const std::uint8_t* rgba) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
    return name;
}

/// For programs whose vertex shader includes surface.glsl and whose fragment shader includes light.glsl.
// Positions and depths must match StrokeProjector's and StrokePass's, or edges would not lie on their
// surfaces.
void set_surface_uniforms(const Program& program, const Camera& camera, const Frame& frame) {
    const glm::mat4& p = camera.projection();
    const glm::vec3 right = camera.right(), up = camera.up(), forward = camera.forward();
    const bool orthographic = camera.pose().orthographic;
    const glm::vec3 target = camera.pose().target;
    program.set("eye", camera.eye());
    program.set(
        "to_eye_space",
        glm::mat4(glm::vec4(right.x, up.x, forward.x, 0.0f), glm::vec4(right.y, up.y, forward.y, 0.0f),
                  glm::vec4(right.z, up.z, forward.z, 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
    program.set("orthographic", orthographic ? 1.0f : 0.0f);
    // Window pixels per metre, at a depth of 1 m (orthographic: everywhere); then pixels to -1 to 1 of the
    // framebuffer.
    const float pixels = (orthographic ? 1.0f : camera.depth(target)) / camera.metres_per_pixel(target);
    const glm::vec2 unit = 2.0f * frame.pixel_ratio / glm::vec2(frame.framebuffer_size);
    const glm::vec2 centre = camera.viewport().centre() * unit;
    program.set("scale", pixels * unit);
    program.set("shift", glm::vec2(centre.x - 1.0f, 1.0f - centre.y));
    program.set("to_clip_depth", glm::vec2(-p[2][2], p[3][2]));
    program.set("sky", glm::vec3(right.y, up.y, -forward.y));
}

}  // namespace

class SkinPass::Sent {
  public:
    explicit Sent(const std::shared_ptr<const SkinnedMesh>& mesh) : mesh_(mesh) {
        glGenVertexArrays(1, &vertex_array_);
        glGenBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
        glBindVertexArray(vertex_array_);
        send(Position, mesh->positions, GL_DYNAMIC_DRAW);
        glVertexAttribPointer(Position, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        send(Normal, mesh->normals, GL_DYNAMIC_DRAW);
        glVertexAttribPointer(Normal, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        if (send(Uv, mesh->uvs)) glVertexAttribPointer(Uv, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        if (send(Tint, mesh->tints)) glVertexAttribPointer(Tint, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
        send(Joints, mesh->weights);
        const auto weights = reinterpret_cast<const void*>(offsetof(JointWeights, weights));
        glVertexAttribIPointer(Joints, 4, GL_UNSIGNED_SHORT, sizeof(JointWeights), nullptr);
        glEnableVertexAttribArray(Weights);
        glVertexAttribPointer(Weights, 4, GL_FLOAT, GL_FALSE, sizeof(JointWeights), weights);
        glGenBuffers(1, &indices_);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     static_cast<GLsizeiptr>(mesh->indices.size() * sizeof mesh->indices[0]),
                     mesh->indices.data(), GL_STATIC_DRAW);
        glBindVertexArray(0);
        for (const Picture& each : mesh->pictures)
            pictures_.push_back(texture_of(each.size, each.rgba.data()));
    }
    ~Sent() {
        glDeleteVertexArrays(1, &vertex_array_);
        glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
        glDeleteBuffers(1, &indices_);
        glDeleteTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
    }
    Sent(const Sent&) = delete;
    Sent& operator=(const Sent&) = delete;

    bool is_gone() const { return mesh_.expired(); }
    GLuint picture(std::int32_t place, GLuint fallback) const {
        return place < 0 ? fallback : pictures_[static_cast<std::size_t>(place)];
    }

    /// Resends the vertices if the morph weights changed.
    void morph(const SkinDraw& draw) {
        const SkinnedMesh& mesh = *draw.mesh;
        if (mesh.morphs.empty()) return;
        std::vector<float> weights = draw.morph_weights;
        for (std::size_t i = weights.size(); i < mesh.morphs.size(); ++i)
            weights.push_back(mesh.morphs[i].weight);
        if (weights == morph_weights_) return;
        morph_weights_ = std::move(weights);
        std::vector<glm::vec3> positions, normals;
        apply_morphs(mesh, morph_weights_, positions, normals);
        send(Position, positions, GL_DYNAMIC_DRAW);
        send(Normal, normals, GL_DYNAMIC_DRAW);
    }
    /// Resends the joint weights if they changed.
    void follow(const SkinDraw& draw) {
        if (draw.weights == weights_) return;
        weights_ = draw.weights;
        send(Joints, weights_ ? *weights_ : draw.mesh->weights);
    }
    /// Binds everything that draw() needs.
    void bind() const {
        glBindVertexArray(vertex_array_);
        glVertexAttrib2f(Uv, 0.0f, 0.0f);
        glVertexAttrib4f(Tint, 1.0f, 1.0f, 1.0f, 1.0f);
    }

  private:
    /// Returns false if there are no values; bind() then sets a constant.
    template <class T>
    bool send(Slot slot, const std::vector<T>& values, GLenum use = GL_STATIC_DRAW) {
        if (values.empty()) return false;
        glBindBuffer(GL_ARRAY_BUFFER, buffers_[slot]);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), use);
        glBindVertexArray(vertex_array_);
        glEnableVertexAttribArray(slot);
        return true;
    }

    std::weak_ptr<const SkinnedMesh> mesh_;
    GLuint vertex_array_ = 0, indices_ = 0;
    std::array<GLuint, 5> buffers_{};
    std::vector<GLuint> pictures_{};
    std::vector<float> morph_weights_{};
    std::shared_ptr<const std::vector<JointWeights>> weights_{};  // null: the mesh's own
};

SkinPass::SkinPass() {
    glGenTextures(1, &matrices_);
    glBindTexture(GL_TEXTURE_2D, matrices_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const std::array<std::uint8_t, 4> white{255, 255, 255, 255};
    white_ = texture_of({1, 1}, white.data());
    glBindTexture(GL_TEXTURE_2D, 0);
}

SkinPass::~SkinPass() {
    glDeleteTextures(1, &matrices_);
    glDeleteTextures(1, &white_);
}

SkinPass::Sent& SkinPass::sent(const std::shared_ptr<const SkinnedMesh>& mesh) {
    std::unique_ptr<Sent>& place = sent_[mesh.get()];
    if (!place) place = std::make_unique<Sent>(mesh);
    return *place;
}

void SkinPass::erase_expired() {
    std::erase_if(sent_, [](const auto& each) { return each.second->is_gone(); });
}

void SkinPass::send_matrices(const std::vector<AffineRows>& matrices) {
    static_assert(sizeof(AffineRows) == 3 * 4 * sizeof(float));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, matrices_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 3, static_cast<GLsizei>(matrices.size()), 0, GL_RGBA, GL_FLOAT,
                 matrices.data());
    glActiveTexture(GL_TEXTURE0);
}

int SkinPass::draw(const std::vector<SkinDraw>& skins, bool solid, const Camera& camera, const Frame& frame) {
    erase_expired();
    int calls = 0;
    for (const SkinDraw& skin : skins) {
        if ((skin.opacity >= 1.0f) != solid || skin.opacity <= 0.0f || !skin.mesh ||
            skin.mesh->indices.empty() || skin.matrices.size() < skin.mesh->joints)
            continue;
        Sent& mesh = sent(skin.mesh);
        mesh.morph(skin);
        mesh.follow(skin);
        program_.use();
        set_surface_uniforms(program_, camera, frame);
        program_.set("picture", 0);
        program_.set("matrices", 1);
        program_.set("opacity", skin.opacity);
        send_matrices(skin.matrices);
        mesh.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LEQUAL);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        for (int pass = solid ? 1 : 0; pass < 2; ++pass) {
            const GLboolean seen = pass == 1 ? GL_TRUE : GL_FALSE;
            glColorMask(seen, seen, seen, seen);
            if (pass == 1 && !solid) glEnable(GL_BLEND);
            for (const SkinPart& part : skin.mesh->parts) {
                glBindTexture(GL_TEXTURE_2D, mesh.picture(part.picture, white_));
                program_.set("part_colour", part.colour * glm::vec4(skin.tint, 1.0f));
                program_.set("cutoff", part.cutoff);
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(part.count), GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t)));
                ++calls;
            }
            glDisable(GL_BLEND);
        }
        glBindVertexArray(0);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    return calls;
}

int MeshPass::draw(const Mesh& mesh, const Camera& camera, const Frame& frame, float opacity) {
    if (mesh.indices.empty()) return 0;
    program_.use();
    set_surface_uniforms(program_, camera, frame);
    program_.set("opacity", opacity);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(opacity < 1.0f ? GL_FALSE : GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    if (opacity < 1.0f)
        glEnable(GL_BLEND);
    else
        glDisable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    triangles_.send(mesh.vertices, mesh.indices);
    triangles_.draw();
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    return 1;
}

}  // namespace tendril::app
