#include "scene/expect_toml.h"

#include "scene/toml_keys.h"

#include <cmath>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Reads one table: [expect], or the one of ms_ratio within it.
struct TableReader {
    const toml::table& table;
    const fs::path& folder;
    const TomlWarning& warning;

    // False where others stand there, too.
    bool knows_all(const std::vector<std::string>& keys) const {
        bool all = true;
        for (const auto& [key, node] : table) {
            const std::string wrong = unknown_key(key.str(), keys);
            if (!wrong.empty()) warning(key.source(), wrong);
            all &= wrong.empty();
        }
        return all;
    }

    std::optional<double> bound(const char* key) const {
        const toml::node* node = table.get(key);
        if (!node) return std::nullopt;
        const auto value = node->value<double>();
        if (value && std::isfinite(*value) && *value >= 0.0) return value;
        warning(node->source(),
                std::string(key) + " is the most that is allowed, a number from 0; not used");
        return std::nullopt;
    }

    fs::path file(const char* key, const char* example) const {
        const toml::node* node = table.get(key);
        if (!node) return {};
        const auto name = node->value<std::string>();
        if (name && !name->empty()) return (folder / *name).lexically_normal();
        warning(node->source(),
                std::string(key) + " is a file's name; write " + key + " = \"" + example + "\"");
        return {};
    }
};

void read_ratio(const toml::node& node, const TableReader& of, Expect& expect) {
    constexpr const char* kForm = "write ms_ratio = { of = \"calm.toml\", most = 1.5 }";
    const toml::table* table = node.as_table();
    if (!table)
        return of.warning(node.source(),
                          std::string("ms_ratio says of which look, and the most; ") + kForm);
    const TableReader reader{*table, of.folder, of.warning};
    const bool knows_all = reader.knows_all({"of", "most"});
    expect.ms_of = reader.file("of", "calm.toml");
    expect.ms_ratio = reader.bound("most");
    if (!expect.ms_of.empty() && expect.ms_ratio) return;
    if (knows_all && (!table->get("of") || !table->get("most")))
        of.warning(node.source(), std::string("ms_ratio needs both, of and most; ") + kForm);
    expect.ms_of.clear();
    expect.ms_ratio.reset();
}

}  // namespace

Expect read_expect(const toml::node& node, const fs::path& folder, const TomlWarning& warning) {
    const toml::table* table = node.as_table();
    if (!table) {
        warning(node.source(), "expect is a table; write [expect] on a line of its own");
        return {};
    }
    const TableReader reader{*table, folder, warning};
    const bool knows_all = reader.knows_all({"picture", "rmse", "flip", "ms_ratio"});
    Expect expect{.picture = reader.file("picture", "expected.png"),
                  .rmse = reader.bound("rmse"),
                  .flip = reader.bound("flip")};
    for (const char* key : {"rmse", "flip"}) {
        const toml::node* bound = table->get(key);
        const bool is_read =
            key == std::string_view("rmse") ? expect.rmse.has_value() : expect.flip.has_value();
        if (bound && is_read && knows_all && !table->get("picture"))
            warning(bound->source(), std::string(key) + " is how far the picture may be from " +
                                         "another; write picture = \"expected.png\", too");
    }
    if (const toml::node* ratio = table->get("ms_ratio")) read_ratio(*ratio, reader, expect);
    return expect;
}

}  // namespace glint
