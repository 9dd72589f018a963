// Tells on stdout how far the studies of a file have come, for those who do not want to wait.
#pragma once

#include "base/json_text.h"
#include "base/say.h"
#include "measure/study/plan.h"
#include "measure/study/result.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace glint {

class StudyLines {
public:
    explicit StudyLines(bool wanted) : wanted_(wanted) {}

    void expect(const StudyPlan& plan, bool time_only, std::size_t views) {
        for (const Knob& knob : plan.knobs) {
            of_ += knob.values.size() + 1;
            if (time_only) continue;
            of_ += 1 + knob.second.has_value() + knob.rival.has_value() +
                   (knob.rival && knob.rival->second);
        }
        of_ *= views;
    }

    // The study as it stands now. `done`: another picture is drawn, or its times are all taken.
    void tell(Study study, const Knob& knob, bool on_software, bool done) {
        done_ += done;
        of_ = std::max(of_, done_);  // a second reference may have to be drawn again
        if (!wanted_) return;
        judge(study, knob, on_software);
        const nlohmann::ordered_json line = {
            {"done", done_}, {"of", of_}, {"study", to_json(study)}};
        say_result("{}\n", json_text(line, -1));
        flush_results();
    }

private:
    bool wanted_;
    std::size_t done_ = 0, of_ = 0;  // pictures, and the times of each knob
};

}  // namespace glint
