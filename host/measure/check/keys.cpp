#include "measure/check/keys.h"

#include "scene/frame.h"

#include <algorithm>
#include <cctype>

namespace glint {
namespace {

// Of a name or a fraction.
bool is_in_a_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

std::vector<int> usual_keys() {
    std::vector<int> keys = {37, 38, 39, 40, 32, 13, 27, 16, 17};
    for (int key = 'A'; key <= 'Z'; ++key) keys.push_back(key);
    for (int key = '0'; key <= '9'; ++key) keys.push_back(key);
    return keys;
}

}  // namespace

bool is_usual_key(int key) {
    static const std::vector<int> usual = usual_keys();
    return std::ranges::find(usual, key) != usual.end();
}

std::vector<int> keys_in_order() {
    std::vector<int> keys = usual_keys();
    for (int key = 0; key < kKeyCount; ++key)
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    return keys;
}

std::vector<int> keys_named(std::string_view text) {
    constexpr int kLeast = 8;  // below are no keys, but many numbers
    std::vector<int> named;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!is_digit(text[at])) continue;
        const std::size_t begin = at;
        int number = 0;
        while (at < text.size() && is_digit(text[at]))
            number = std::min(1000, 10 * number + text[at++] - '0');
        const bool is_alone = (begin == 0 || !is_in_a_word(text[begin - 1])) &&
                              (at == text.size() || !is_in_a_word(text[at]));
        const bool is_key = is_alone && number >= kLeast && number < kKeyCount;
        if (is_key && std::ranges::find(named, number) == named.end()) named.push_back(number);
    }
    return named;
}

}  // namespace glint
