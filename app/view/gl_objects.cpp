#include "app/view/gl_objects.hpp"

#include <cstddef>
#include <stdexcept>

#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

/// A shader's source with its version, and with its `#include "..."` lines replaced by those files; GLSL has
/// no #include.
std::string whole_source(const std::string& file) {
    constexpr std::string_view before = "\n#include \"", after = "\"\n";
    std::string text = std::string(shader_version) + '\n' + shader_precision;
    text += shader_source(file);
    for (std::size_t at = text.find(before); at != text.npos; at = text.find(before, at)) {
        const std::size_t name = at + before.size(), end = text.find(after, name);
        if (end == text.npos) throw std::runtime_error("shader " + file + ": an #include without its end");
        const std::string_view included = shader_source(text.substr(name, end - name));
        text.replace(at + 1, end + 1 - at, included);
    }
    return text;
}

class Shader {
  public:
    Shader(GLenum kind, const std::string& file) : name_(glCreateShader(kind)) {
        const std::string source = whole_source(file);
        const GLchar* const text = source.data();
        const auto length = static_cast<GLint>(source.size());
        glShaderSource(name_, 1, &text, &length);
        glCompileShader(name_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) return;
        std::string words(4096, '\0');
        GLsizei said = 0;
        glGetShaderInfoLog(name_, static_cast<GLsizei>(words.size()), &said, words.data());
        words.resize(static_cast<std::size_t>(said));
        glDeleteShader(name_);
        throw std::runtime_error("shader " + file + ": " + words);
    }
    ~Shader() { glDeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

/// Writes to the bound buffer, which grows by half again when it is too small.
void send_to(GLenum target, std::size_t& capacity, const void* data, std::size_t bytes) {
    if (bytes > capacity) {
        capacity = bytes + bytes / 2;
        glBufferData(target, static_cast<GLsizeiptr>(capacity), nullptr, GL_STREAM_DRAW);
    }
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes), data);
}

}  // namespace

Program::Program(const std::string& vertex, const std::string& fragment) {
    const Shader v(GL_VERTEX_SHADER, vertex), f(GL_FRAGMENT_SHADER, fragment);
    name_ = glCreateProgram();
    glAttachShader(name_, v.name());
    glAttachShader(name_, f.name());
    glLinkProgram(name_);
    GLint linked = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return;
    std::string words(4096, '\0');
    GLsizei said = 0;
    glGetProgramInfoLog(name_, static_cast<GLsizei>(words.size()), &said, words.data());
    words.resize(static_cast<std::size_t>(said));
    glDeleteProgram(name_);
    throw std::runtime_error("shaders " + vertex + " and " + fragment + ": " + words);
}

Instances::Instances(std::size_t stride, std::span<const Attribute> attributes)
    : stride_(stride), attributes_(attributes.begin(), attributes.end()) {
    glGenVertexArrays(1, &vertex_array_);
    glGenBuffers(1, &buffer_);
    glBindVertexArray(vertex_array_);
    for (GLuint i = 0; i < attributes_.size(); ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribDivisor(i, 1);
    }
    glBindVertexArray(0);
}

Instances::~Instances() {
    glDeleteVertexArrays(1, &vertex_array_);
    glDeleteBuffers(1, &buffer_);
}

void Instances::send(const void* data, std::size_t bytes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    send_to(GL_ARRAY_BUFFER, capacity_, data, bytes);
}

void Instances::draw(std::size_t first, std::size_t count) const {
    glBindVertexArray(vertex_array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    // GL 3.3 has no base instance: offset the attributes instead.
    for (GLuint i = 0; i < attributes_.size(); ++i) {
        const Attribute& a = attributes_[i];
        const GLboolean normalised = a.type == GL_FLOAT ? GL_FALSE : GL_TRUE;
        glVertexAttribPointer(i, a.components, a.type, normalised, static_cast<GLsizei>(stride_),
                              reinterpret_cast<const void*>(first * stride_ + a.offset));
    }
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
    glBindVertexArray(0);
}

Triangles::Triangles() {
    glGenVertexArrays(1, &vertex_array_);
    glGenBuffers(1, &vertices_);
    glGenBuffers(1, &indices_);
    glBindVertexArray(vertex_array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    const std::size_t members[]{offsetof(Vertex, position), offsetof(Vertex, normal),
                                offsetof(Vertex, colour), offsetof(Vertex, back)};
    for (GLuint i = 0; i < std::size(members); ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(members[i]));
    }
    glBindVertexArray(0);
}

Triangles::~Triangles() {
    glDeleteVertexArrays(1, &vertex_array_);
    glDeleteBuffers(1, &vertices_);
    glDeleteBuffers(1, &indices_);
}

void Triangles::send(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices) {
    // The indices' buffer is part of the vertex array's state.
    glBindVertexArray(vertex_array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_);
    send_to(GL_ARRAY_BUFFER, vertices_capacity_, vertices.data(), vertices.size_bytes());
    send_to(GL_ELEMENT_ARRAY_BUFFER, indices_capacity_, indices.data(), indices.size_bytes());
    glBindVertexArray(0);
    count_ = indices.size();
}

void Triangles::draw() const {
    glBindVertexArray(vertex_array_);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count_), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

}  // namespace tendril::app
