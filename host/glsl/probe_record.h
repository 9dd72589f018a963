// What notes a variable's value once it has it: `glint0_v(8,t)`.
#pragma once

#include "glsl/probe_types.h"
#include "glsl/variables.h"

#include <cstdint>
#include <string>
#include <vector>

namespace glint {

// Variables are named by the tokens of their places, in a function by its number.
class ProbeRecords {
public:
    // `reading` must outlive this.
    explicit ProbeRecords(const Reading& reading)
        : reading_(reading), variables_(reading), structs_(reading) {}

    const Variables& variables() const { return variables_; }
    const StructTypes& structs() const { return structs_; }

    // A name with members and indices that can be evaluated once more: without a call of the
    // text's own.
    bool is_variable(TokenRange range) const;
    // Whether it is the same element behind a call that hands out these, or changes globals.
    bool is_steady(TokenRange variable, const std::vector<TokenRange>& outs,
                   std::uint32_t function) const;
    // An array or a struct, as a whole, that no function of the probe takes.
    bool is_told_behind(TokenRange range, std::uint32_t function) const {
        return is_whole_array(range, function) || bare_struct_of(range, function) != kNone;
    }
    // Into structs: that of this variable or element, where no function takes it, since the
    // function itself declares it, or not all of it can be told; kNone otherwise.
    std::uint32_t bare_struct_of(TokenRange range, std::uint32_t function) const;
    // The expression that notes it for a site; "" where it cannot be told.
    std::string record_of(std::size_t site, TokenRange variable, std::uint32_t function) const;

private:
    bool is_whole_array(TokenRange range, std::uint32_t function) const;

    const Reading& reading_;
    Variables variables_;
    StructTypes structs_;
};

}  // namespace glint
