// What the source panel is told of the open scene: asks the process that probes, one question at a
// time, and keeps the last answer.
#pragma once

#include "render/buffer.h"
#include "window/live/playground.h"
#include "window/live/value_picture.h"
#include "window/trial/prober.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// What is to be known now.
struct ProbeQuestion {
    std::size_t pass = kImagePass;
    std::optional<glm::ivec2> pixel{};  // of the pass's buffer
    Span lines{};                       // of the text, in view
    std::optional<ValueName> value{};   // in every pixel
    bool cost = false;
    std::vector<std::string> watch{};
};

class LiveProbe {
public:
    explicit LiveProbe(const std::string& device) : prober_(device) {}

    // Hears the process and asks what is not known yet; does not wait. True when there is something
    // new. Something has been drawn, and the pass is one of those that are.
    bool follow(Playground& playground, const ProbeQuestion& question);
    // Ends the process and forgets. Costs nothing where nothing was asked.
    void stop();

    // The map of the value that was asked for, as a picture; null where there is none.
    const Buffer* picture(ValueLook look);
    void tell(ProbeFact& fact) const;

    int descriptor() const { return prober_.descriptor(); }  // for ::poll()
    // A question waits for the tweaks to rest, or for the last answer to be old enough.
    bool is_waiting() const { return is_waiting_; }

private:
    struct Subject {
        std::string text;
        std::vector<TweakValue> values;
        std::vector<std::string> watch;
        glm::ivec2 size{0};
        std::size_t pass = 0, reports = 0;
        bool operator==(const Subject&) const = default;
    };
    bool hear();
    void take(ProbeAnswer answer);
    void forget_map();
    bool follow_subject(Playground& playground, const ProbeQuestion& question);
    Span widened(const std::string& text, Span lines) const;
    void ask(Playground& playground, const ProbeQuestion& question, bool wants_map);

    Prober prober_;
    std::optional<Subject> subject_, next_;  // what was asked about; what is to be, once it rests
    Stopwatch since_next_, since_answer_, since_scroll_;
    Span seen_{};  // lines in view
    std::uint64_t number_ = 0, subject_number_ = 0;
    std::size_t instant_ = 0;  // pictures drawn when it was asked
    ProbeQuestion asked_{}, mapped_{};
    bool is_known_ = false;  // the last question was answered
    bool is_waiting_ = false;

    Probing found_{};
    ProbeAnswer answer_{};  // without what was taken from it
    std::optional<ValueMap> map_;
    ValueFacts facts_{};
    int row_ = -1;
    std::unique_ptr<Buffer> picture_;
    std::optional<ValueLook> look_;
};

}  // namespace glint
