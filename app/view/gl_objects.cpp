#include "app/view/gl_objects.hpp"

#include <stdexcept>

#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

class Shader {
  public:
    Shader(GLenum kind, const std::string& file) : name_(glCreateShader(kind)) {
        const std::string_view source = shader_source(file);
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
    if (bytes > capacity_) {
        capacity_ = bytes + bytes / 2;
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
    }
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void Instances::draw(std::size_t first, std::size_t count) const {
    glBindVertexArray(vertex_array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    // GL 3.3 has no base instance: the first one is where the attributes begin.
    for (GLuint i = 0; i < attributes_.size(); ++i) {
        const Attribute& a = attributes_[i];
        const GLboolean normalised = a.type == GL_FLOAT ? GL_FALSE : GL_TRUE;
        glVertexAttribPointer(i, a.components, a.type, normalised, static_cast<GLsizei>(stride_),
                              reinterpret_cast<const void*>(first * stride_ + a.offset));
    }
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
    glBindVertexArray(0);
}

}  // namespace tendril::app
