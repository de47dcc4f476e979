// RAII wrappers of GL objects. Used inside the renderer only.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/view/draw_list.hpp"
#include "app/window/gl.hpp"

namespace tendril::app {

/// A shader program from two embedded files.
class Program {
  public:
    /// Throws std::runtime_error with the driver's log.
    Program(const std::string& vertex, const std::string& fragment);
    ~Program() { glDeleteProgram(name_); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const { glUseProgram(name_); }
    void set(const char* uniform, int value) const { glUniform1i(at(uniform), value); }
    void set(const char* uniform, float value) const { glUniform1f(at(uniform), value); }
    void set(const char* uniform, glm::vec2 value) const { glUniform2f(at(uniform), value.x, value.y); }
    void set(const char* uniform, glm::vec3 value) const {
        glUniform3f(at(uniform), value.x, value.y, value.z);
    }
    void set(const char* uniform, glm::vec4 v) const { glUniform4f(at(uniform), v.x, v.y, v.z, v.w); }
    void set(const char* uniform, const glm::mat4& value) const {
        glUniformMatrix4fv(at(uniform), 1, GL_FALSE, &value[0][0]);
    }

  private:
    GLint at(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

    GLuint name_ = 0;
};

/// One attribute of an instance: its type, and its offset in the instance's struct.
struct Attribute {
    GLint components = 4;
    GLenum type = GL_FLOAT;
    std::size_t offset = 0;
};

/// Instances of a quad, sent each frame and drawn in one call.
class Instances {
  public:
    Instances(std::size_t stride, std::span<const Attribute> attributes);
    ~Instances();
    Instances(const Instances&) = delete;
    Instances& operator=(const Instances&) = delete;

    void send(const void* data, std::size_t bytes);
    /// The corners are gl_VertexID 0 to 3, in triangle strip order.
    void draw(std::size_t first, std::size_t count) const;

  private:
    std::size_t stride_;
    std::vector<Attribute> attributes_;
    GLuint vertex_array_ = 0;
    GLuint buffer_ = 0;
    std::size_t capacity_ = 0;  ///< bytes
};

/// A mesh, sent each frame and drawn in one call. Attributes 0 to 3 are the members of Vertex.
class Triangles {
  public:
    Triangles();
    ~Triangles();
    Triangles(const Triangles&) = delete;
    Triangles& operator=(const Triangles&) = delete;

    void send(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices);
    void draw() const;

  private:
    GLuint vertex_array_ = 0, vertices_ = 0, indices_ = 0;
    std::size_t vertices_capacity_ = 0, indices_capacity_ = 0;  ///< bytes
    std::size_t count_ = 0;
};

}  // namespace tendril::app
