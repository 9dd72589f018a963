// What a scene says of its buffers: `bounded=[a, b]`, `conserves=1e-6`; held against every frame.
#pragma once

#include "measure/check/subject.h"
#include "measure/rows/curve.h"

#include <limits>
#include <string>
#include <vector>

namespace glint {

class Invariants {
public:
    explicit Invariants(const CheckSubject& subject);
    bool any() const { return !list_.empty(); }
    void add(const CheckSubject& subject, int frame);
    // The first that did not hold, in words; "" where all did.
    const std::string& broken() const { return broken_; }
    // "waves within [-0.31, 0.29], drifted by 2e-08": what they came to.
    std::string words() const;
    // One a promised buffer.
    std::vector<InvariantCurve> curves() const;

private:
    struct One {
        std::size_t index, output;  // of the graph, of the pass
        const Sampler* sampler;
        float low = std::numeric_limits<float>::infinity(), high = -low;
        double first = 0.0, drift = 0.0;  // the sum; how far it has gone, as a share
        bool is_begun = false;
        InvariantCurve curve{};
    };
    void look(One& one, const std::vector<float>& values, int frame);

    std::vector<One> list_;
    std::string broken_;
};

}  // namespace glint
