// Which declaration a name means, where it stands.
#pragma once

#include "glsl/reading.h"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace glint {

class Variables {
public:
    // `reading` must outlive this.
    explicit Variables(const Reading& reading);

    struct Found {
        const Declaration* declaration = nullptr;  // null: none is known
        const Declarator* name = nullptr;
    };
    // What the name at this token of a function's body means.
    Found find(std::uint32_t token, std::uint32_t function) const;

private:
    bool is_seen(const Declaration& declaration, std::uint32_t token) const;

    struct Place {
        std::uint32_t declaration, name;
    };
    const Reading& reading_;
    std::unordered_map<std::string_view, std::vector<Place>> places_;  // in the order of the text
};

}  // namespace glint
