// The types whose values can be told, and how they are cut into leaves of up to four numbers.
#pragma once

#include "glsl/probe.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

inline constexpr std::array<const char*, 16> kProbeTypes = {
    "float", "vec2",  "vec3",  "vec4",  "int",  "ivec2", "ivec3", "ivec4",
    "uint",  "uvec2", "uvec3", "uvec4", "bool", "bvec2", "bvec3", "bvec4"};
inline constexpr std::array<const char*, 9> kProbeMatrices = {
    "mat2", "mat2x3", "mat2x4", "mat3x2", "mat3", "mat3x4", "mat4x2", "mat4x3", "mat4"};

// 0 to 15 of "float" … "bvec4"; -1 of others.
int probe_type_of(std::string_view type);
// 2 to 4 of a matrix; 0 of what is none.
int matrix_columns(std::string_view type);
int matrix_rows(std::string_view type);

// `(glint0_has(7,a.length())&&…)`, which notes what the array `a` of this type holds, the first 64
// elements; empty where its elements are no numbers.
std::string array_record(std::size_t site, const std::string& name, std::string_view type);

// The structs of a text.
class StructTypes {
public:
    // `reading` must outlive this.
    explicit StructTypes(const Reading& reading) : reading_(reading) {}

    // `.nor`, `.m[0]`, `.hit.t`; empty where some member cannot be told.
    ProbeLeaves leaves(std::uint32_t structure) const;
    // Notes the leaves of such a value, calls with a comma between them; empty as above.
    std::string record(std::uint32_t structure, const std::string& site,
                       const std::string& value) const;
    // Of an array of such values, as array_record() of numbers.
    std::string array_record(std::uint32_t structure, std::size_t site,
                             const std::string& name) const;
    // `S glint0_v(int i, S v) { … }`, where it can be told, and what else takes a value of it.
    std::string overloads(std::uint32_t structure, ProbeKind kind) const;

private:
    struct Leaf {
        std::string path, type;
    };
    bool add_leaves(std::uint32_t structure, const std::string& path, int depth,
                    std::vector<Leaf>& leaves) const;
    const Reading& reading_;
};

}  // namespace glint
