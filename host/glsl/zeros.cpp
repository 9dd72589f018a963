#include "glsl/zeros.h"

#include "glsl/first_use.h"
#include "glsl/zero_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace glint {
namespace {

// A place where a value is written, and how.
struct Site {
    // An `entry` begins with its outputs as the host has set them, to 0.
    enum class Kind : std::uint8_t { initial, head, entry, result };
    Kind kind = Kind::initial;
    Unset unset;
    SpelledType type;
    std::uint32_t token = kNone;  // behind which, or before which for a result
    // Behind which a local or a global may be given its value by statements; kNone: nowhere.
    std::uint32_t statements = kNone;
    // How often that is done in a pixel, as far as calls tell; infinite within a loop.
    double times = 1.0;
};

class ZeroFinder {
public:
    ZeroFinder(const Reading& reading, std::string_view entry)
        : reading_(reading), uses_(reading), entry_(entry) {}

    // In the order of the text.
    std::vector<Site> find() {
        times_.assign(reading_.functions.size(), std::nullopt);
        for (const Declaration& declaration : reading_.declarations)
            if (declaration.scope == Scope::local || declaration.scope == Scope::global)
                find_in(declaration);
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i)
            if (reading_.functions[i].first_statement != kNone) find_in_function(i);
        std::ranges::stable_sort(sites_, {}, [](const Site& site) { return site.unset.at; });
        return std::move(sites_);
    }

private:
    bool is_in_loop(std::uint32_t function, std::uint32_t token) const {
        const std::uint32_t first = reading_.functions[function].first_statement;
        for (std::uint32_t at = first; at < reading_.statements[first].next; ++at) {
            const Statement& one = reading_.statements[at];
            if (is_loop(one.kind) && one.tokens.begin <= token && token < one.tokens.end)
                return true;
        }
        return false;
    }

    // How often a place in a function is come to.
    double times_at(std::uint32_t function, std::uint32_t token) {
        if (reading_.functions[function].first_statement == kNone) return 1.0;
        return is_in_loop(function, token) ? HUGE_VAL : times_of(function);
    }

    // Once of what nobody calls, and for each call of that name.
    double times_of(std::uint32_t function) {
        std::optional<double>& times = times_[function];
        if (times) return *times;
        times = HUGE_VAL;  // one that calls itself is no GLSL
        double sum = 0.0;
        const std::string_view name = reading_.word(reading_.functions[function].name);
        for (const Call& call : reading_.calls)
            if (reading_.word(call.name) == name)
                sum += call.function == kNone ? 1.0 : times_at(call.function, call.name);
        return *(times_[function] = std::max(sum, 1.0));
    }

    // Of what may be long alone: the calls of a text are many.
    template <class Times>
    void note_times(const Times& times) {
        const SpelledType& type = sites_.back().type;
        const bool is_basic = type.array.empty() && type.type_array.empty() &&
                              !basic_value(reading_.word(type.type), FirstValue::zero).empty();
        if (!is_basic) sites_.back().times = times();
    }

    // The function in whose body a token stands; kNone: in none.
    std::uint32_t function_of(std::uint32_t token) const {
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i)
            if (const TokenRange body = reading_.functions[i].body;
                body.begin <= token && token < body.end)
                return i;
        return kNone;
    }

    // Whatever else qualifies it, such as `const` or `in`, has a value or is an error.
    bool is_plain(const Declaration& declaration) const {
        constexpr std::array<std::string_view, 4> kPrecisions = {"highp", "mediump", "lowp",
                                                                 "precise"};
        for (std::uint32_t at = declaration.qualifiers.begin; at < declaration.qualifiers.end; ++at)
            if (std::ranges::find(kPrecisions, reading_.word(at)) == kPrecisions.end())
                return false;
        return true;
    }

    void add(Site::Kind kind, std::uint32_t name, std::uint32_t token, const SpelledType& type) {
        sites_.push_back({kind,
                          {.name = std::string(reading_.word(name)),
                           .is_result = kind == Site::Kind::result,
                           .at = reading_.place(name).begin},
                          type,
                          token});
    }

    void find_in(const Declaration& declaration) {
        if (!is_plain(declaration)) return;
        for (const Declarator& one : declaration.names) {
            if (!one.initial.empty()) continue;
            const bool is_read = declaration.scope == Scope::global
                                     ? uses_.is_mentioned_again(reading_.word(one.name))
                                     : uses_.local_is_read(declaration, one);
            if (!is_read) continue;
            add(Site::Kind::initial, one.name, one.tokens.end - 1,
                {.type = declaration.type,
                 .structure = declaration.structure,
                 .array = one.array,
                 .type_array = declaration.type_array});
            if (is_jumped_over(declaration))
                sites_.back().unset.why_not = "a switch may jump over its declaration";
            else
                sites_.back().statements = place_of_statements(declaration, one);
            if (const std::uint32_t function = function_of(one.name); function != kNone)
                note_times([&] { return times_at(function, one.name); });
        }
    }

    // Behind a local's declaration, whose later names must not read it; at the head of the entry,
    // for a global.
    std::uint32_t place_of_statements(const Declaration& declaration, const Declarator& one) const {
        if (declaration.scope == Scope::global) {
            for (const std::uint32_t index : reading_.functions_named(entry_))
                if (const Function& function = reading_.functions[index];
                    may_begin_with(function, one))
                    return function.body.begin;
            return kNone;
        }
        if (declaration.statement == kNone) return kNone;
        const Statement& statement = reading_.statements[declaration.statement];
        const bool is_in_block = statement.kind == StatementKind::declaration &&
                                 statement.parent != kNone &&
                                 reading_.statements[statement.parent].kind == StatementKind::block;
        if (!is_in_block) return kNone;
        for (const Declarator& other : declaration.names)
            if (other.name > one.name && !other.initial.empty()) return kNone;
        return declaration.tokens.end - 1;
    }

    // Whether an entry begins the drawing, knows the global, and both are compiled.
    bool may_begin_with(const Function& function, const Declarator& global) const {
        const auto is_certain = [&](std::uint32_t token) {
            return reading_.live_at(reading_.place(token).begin) == Live::yes;
        };
        const auto hides_it = [&](std::uint32_t parameter) {
            return std::ranges::any_of(
                reading_.declarations[parameter].names, [&](const Declarator& name) {
                    return reading_.word(name.name) == reading_.word(global.name);
                });
        };
        return function.is_defined() && function.body.begin > global.name &&
               reading_.is_for_the_host(function, entry_) && is_certain(global.name) &&
               is_certain(function.body.begin) &&
               std::ranges::none_of(function.parameters, hides_it);
    }

    // Right in a switch's block.
    bool is_jumped_over(const Declaration& declaration) const {
        if (declaration.statement == kNone) return false;
        const std::uint32_t block = reading_.statements[declaration.statement].parent;
        if (block == kNone || reading_.statements[block].parent == kNone) return false;
        const Statement& holder = reading_.statements[reading_.statements[block].parent];
        return holder.kind == StatementKind::switch_;
    }

    void find_in_function(std::uint32_t index) {
        const Function& function = reading_.functions[index];
        const bool is_entry = reading_.is_for_the_host(function, entry_);
        for (std::size_t i = 0; i < function.parameters.size(); ++i) {
            const Declaration& declaration = reading_.declarations[function.parameters[i]];
            if (!declaration.is_out || declaration.is_in) continue;
            const bool is_named = !declaration.names.empty();
            Declarator one;
            one.name = declaration.tokens.end - 1;
            if (is_named) one = declaration.names.front();
            if (is_named && !uses_.out_is_read(index, reading_.word(one.name))) continue;
            add(is_entry ? Site::Kind::entry : Site::Kind::head, one.name, function.body.begin,
                {.type = declaration.type,
                 .structure = declaration.structure,
                 .array = one.array,
                 .type_array = declaration.type_array});
            Unset& unset = sites_.back().unset;
            if (!is_named) unset.name = unnamed_parameter(i);
            unset.has_no_name = !is_named;
            unset.is_output = is_entry;
            note_times([&] { return times_of(index); });
        }
        if (reading_.word(function.type) == "void" || !uses_.lacks_return(function)) return;
        add(Site::Kind::result, function.name, function.body.end - 1,
            {.type = function.type, .array = {}, .type_array = function.type_array});
        note_times([&] { return times_of(index); });
    }

    const Reading& reading_;
    FirstUses uses_;
    std::string_view entry_;
    std::vector<std::optional<double>> times_;  // by function
    std::vector<Site> sites_;
};

class Writer {
public:
    Writer(const Reading& reading, Edits& edits)
        : reading_(reading), values_(reading), edits_(edits), is_named_(reading.structs.size()) {}

    // False where it cannot be done.
    bool write(const Site& site, FirstValue first) {
        if (site.kind == Site::Kind::entry && first == FirstValue::zero) return true;
        // Turns of loops are few on one driver: 65,535 of all loops of a pixel.
        constexpr double kSeldom = 4.0;
        const bool is_seldom = site.times <= kSeldom;
        if (is_seldom && values_.is_long(site.type) && write_statements(site, first)) return true;
        const auto value = values_.value(site.type, first);
        if (!value) return write_statements(site, first);
        if (!name_struct(site.type)) return false;
        switch (site.kind) {
            case Site::Kind::initial:
                return edits_.after(site.token, " = " + *value);
            case Site::Kind::head:
            case Site::Kind::entry:
                return edits_.after(site.token, " " + site.unset.name + " = " + *value + ";");
            case Site::Kind::result:
                return edits_.before(site.token, " return " + *value + "; ");
        }
        return false;
    }

private:
    // For arrays whose length only the compiler knows, or that are long.
    bool write_statements(const Site& site, FirstValue first) {
        const bool is_result = site.kind == Site::Kind::result;
        const std::string name = is_result ? "glint_result" : site.unset.name;
        const auto words = values_.statements(name, site.type, first);
        if (!words) return false;
        if (is_result) {
            const std::string type = fmt::format("{}{}", reading_.word(site.type.type),
                                                 reading_.spelled(site.type.type_array));
            return edits_.before(site.token,
                                 fmt::format(" {} {};{} return {}; ", type, name, *words, name));
        }
        const std::uint32_t place = site.kind == Site::Kind::head ? site.token : site.statements;
        return place != kNone && edits_.after(place, *words);
    }

    // A constructor needs the name that a struct has not got.
    bool name_struct(const SpelledType& type) {
        if (type.type != kNone || is_named_[type.structure]) return true;
        is_named_[type.structure] = edits_.after(reading_.structs[type.structure].tokens.begin,
                                                 " " + ZeroValues::made_name(type.structure));
        return is_named_[type.structure];
    }

    const Reading& reading_;
    ZeroValues values_;
    Edits& edits_;
    std::vector<bool> is_named_;
};

}  // namespace

std::string unnamed_parameter(std::size_t index) {
    return fmt::format("glint_parameter{}", index);
}

std::vector<Unset> write_zeros(const Reading& reading, Edits& edits, std::string_view entry,
                               std::optional<Marked> marked) {
    std::vector<Unset> unset;
    if (!reading.is_balanced) return unset;
    Writer writer(reading, edits);
    for (Site& site : ZeroFinder(reading, entry).find()) {
        const bool is_marked = marked && marked->holds(site.unset);
        if (!writer.write(site, is_marked ? marked->value : FirstValue::zero))
            site.unset.why_not = "no value can be written for its type, or a macro keeps it";
        unset.push_back(std::move(site.unset));
    }
    return unset;
}

}  // namespace glint
