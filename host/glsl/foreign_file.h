// The directives of VS Code's Shader Toy in one file.
#pragma once

#include "glsl/preprocess.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// `iChannel0` to `iChannel3`.
bool is_channel(std::string_view word);

// What a channel's lines say, gathered from the whole file.
struct ForeignChannel {
    int line = 0;        // of `#iChannelN "…"`; 0: there is none
    std::string source;  // "self", "keyboard", a path
    std::string min_filter, mag_filter, wrap, type;
};
using ForeignChannels = std::array<ForeignChannel, 4>;

// `#iUniform color3 tint = color3(1.0, 0.5, 0.0) in { 0.0, 1.0 } step 0.1 // what it does`. Without
// a value it begins with its range, or 0.
struct ForeignUniform {
    std::string type, name;
    std::vector<std::string> value;  // one number for all components, or one for each
    std::vector<std::string> range;  // two, or none
    std::string step, description;   // empty for none
};

class ForeignFile {
public:
    ForeignFile(std::string_view text, const Known& known);
    ForeignFile(const ForeignFile&) = delete;
    ForeignFile& operator=(const ForeignFile&) = delete;

    int line_count() const { return static_cast<int>(line_begins_.size()); }
    std::string line(int number) const;  // from 1
    // The directives that may count, by their lines.
    const std::map<int, const Directive*>& directives() const { return directives_; }
    bool mentions(std::string_view word) const { return read_.mentions(word); }

    ForeignChannels channels() const;
    // Why a channel's line says nothing, as a sentence; "" where it does.
    std::string why_nothing_is_said(const Directive& channel) const;
    // Nothing where it is not understood.
    std::optional<ForeignUniform> uniform(const Directive& directive) const;

private:
    std::span<const Token> rest(const Directive& directive) const;
    std::string comment_in(Span span) const;

    std::string text_;
    Preprocessed read_;
    std::vector<std::size_t> line_begins_;
    std::map<int, const Directive*> directives_;
};

}  // namespace glint
