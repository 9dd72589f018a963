// Values that no simulation should ever hold, put into its buffers.
#pragma once

#include "measure/check/subject.h"

#include <vector>

namespace glint {

// Texels that matter first: the corner, where small states live; the one with the largest value,
// which is in use; the middle; then any.
std::vector<glm::ivec2> texels_to_poison(const CheckSubject& subject, std::size_t index, int count);
void poison(const Buffer& buffer, glm::ivec2 texel, float value);

// Puts into each of these texels, and into those so many texels round it, what stands elsewhere in
// the buffer: `times` a quarter of its size away. A state as sound as any, of a buffer that is no
// cube.
void exchange(const CheckSubject& subject, std::size_t index, const std::vector<glm::ivec2>& texels,
              int round, int times);

// Fills one output of a buffer that is no cube: RGBA, rows bottom up.
void put_values(const CheckSubject& subject, std::size_t index, std::size_t output,
                const std::vector<float>& values);

// Puts what this makes of each value into a buffer that is no cube.
void change_values(const CheckSubject& subject, std::size_t index, float (*changed)(float));

}  // namespace glint
