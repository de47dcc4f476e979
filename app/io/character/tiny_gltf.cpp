#define TINYGLTF_IMPLEMENTATION
#include "app/io/character/tiny_gltf.hpp"
