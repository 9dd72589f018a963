// glint-sound.so: sound files, other sample rates, spectra. Loaded when the first of them is met.
#include "media/sound_module.h"

#include <kiss_fftr.h>
#include <ogg/ogg.h>
#include <samplerate.h>
#include <sndfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace {

constexpr int kRate = 44100;       // Hz
constexpr double kLongest = 3600;  // s; half a gigabyte
constexpr int kFftSize = 2048, kBins = 512;

int give_up(std::string cause, char* to, size_t size) {
    while (!cause.empty() && (cause.back() == '.' || cause.back() == ' ')) cause.pop_back();
    std::snprintf(to, size, "%s", cause.c_str());
    return 0;
}

struct CloseFile {
    void operator()(SNDFILE* file) const { sf_close(file); }
};
struct DeleteResampler {
    void operator()(SRC_STATE* state) const { src_delete(state); }
};

int16_t to_sample(float value) {
    return static_cast<int16_t>(std::lround(std::clamp(value * 32768.0f, -32768.0f, 32767.0f)));
}

// What follows reading: to 44.1 kHz, to 16 bits, to whoever takes it.
class Taker {
public:
    Taker(int rate, int (*take)(void*, const int16_t*, size_t), void* user)
        : ratio_(static_cast<double>(kRate) / rate), take_(take), user_(user) {
        int error = 0;
        if (rate != kRate) resampler_.reset(src_new(SRC_SINC_FASTEST, 2, &error));
    }

    bool can_resample() const {
        return ratio_ == 1.0 || (resampler_ && src_is_valid_ratio(ratio_));
    }

    // False when nobody wants more.
    bool put(const std::vector<float>& pairs, bool is_last) {
        if (!resampler_) return hand_on(pairs.data(), pairs.size());
        std::array<float, 8192> out;
        SRC_DATA data{};
        data.data_in = pairs.data();
        data.input_frames = static_cast<long>(pairs.size() / 2);
        data.src_ratio = ratio_;
        data.end_of_input = is_last;
        do {
            data.data_out = out.data();
            data.output_frames = static_cast<long>(out.size() / 2);
            if (src_process(resampler_.get(), &data) != 0) return false;
            data.data_in += 2 * data.input_frames_used;
            data.input_frames -= data.input_frames_used;
            if (!hand_on(out.data(), static_cast<size_t>(data.output_frames_gen) * 2)) return false;
        } while (data.input_frames > 0 || data.output_frames_gen > 0);
        return true;
    }

private:
    bool hand_on(const float* values, size_t count) {
        samples_.resize(count);
        std::transform(values, values + count, samples_.begin(), to_sample);
        return take_(user_, samples_.data(), count / 2) != 0;
    }

    double ratio_;
    int (*take_)(void*, const int16_t*, size_t);
    void* user_;
    std::unique_ptr<SRC_STATE, DeleteResampler> resampler_;
    std::vector<int16_t> samples_;
};

// Writes where it is told and remembers what the system refused.
struct Writer {
    int descriptor = -1;
    sf_count_t at = 0;
    int error = 0;
    SNDFILE* file = nullptr;
    bool is_ogg = false;
};

sf_count_t length_of(void* user) {
    struct stat status {};
    fstat(static_cast<Writer*>(user)->descriptor, &status);
    return status.st_size;
}

sf_count_t seek(sf_count_t offset, int whence, void* user) {
    Writer& writer = *static_cast<Writer*>(user);
    const sf_count_t from = whence == SEEK_SET   ? 0
                            : whence == SEEK_CUR ? writer.at
                                                 : length_of(user);
    return writer.at = from + offset;
}

sf_count_t read_back(void* to, sf_count_t count, void* user) {
    Writer& writer = *static_cast<Writer*>(user);
    const ssize_t got = pread(writer.descriptor, to, static_cast<size_t>(count), writer.at);
    if (got < 0) writer.error = errno;
    writer.at += std::max<ssize_t>(got, 0);
    return std::max<ssize_t>(got, 0);
}

sf_count_t write_out(const void* from, sf_count_t count, void* user) {
    Writer& writer = *static_cast<Writer*>(user);
    sf_count_t done = 0;
    while (done < count) {
        const ssize_t put = pwrite(writer.descriptor, static_cast<const char*>(from) + done,
                                   static_cast<size_t>(count - done), writer.at);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) {
            writer.error = put < 0 ? errno : ENOSPC;
            break;
        }
        done += put, writer.at += put;
    }
    return done;
}

sf_count_t place_of(void* user) {
    return static_cast<Writer*>(user)->at;
}

// libsndfile numbers each stream by the clock, in every page (RFC 3533, section 6). Here all are
// stream 0: the same sound has the same bytes.
void number_pages(Writer& writer) {
    constexpr size_t kHead = 27, kSerial = 14, kSegments = 26;
    std::vector<unsigned char> page(kHead);
    for (writer.at = 0; read_back(page.data(), kHead, &writer) == kHead;) {
        const sf_count_t begin = writer.at - static_cast<sf_count_t>(kHead);
        const size_t head = kHead + page[kSegments];
        page.resize(head);
        read_back(page.data() + kHead, static_cast<sf_count_t>(head - kHead), &writer);
        const size_t body = std::accumulate(page.begin() + kHead, page.end(), size_t{0});
        page.resize(head + body);
        read_back(page.data() + head, static_cast<sf_count_t>(body), &writer);
        std::fill_n(&page[kSerial], 4, 0);
        ogg_page whole{page.data(), static_cast<long>(head), page.data() + head,
                       static_cast<long>(body)};
        ogg_page_checksum_set(&whole);
        writer.at = begin;
        write_out(page.data(), static_cast<sf_count_t>(head + body), &writer);
        page.resize(kHead);
        if (writer.error != 0) return;
    }
}

}  // namespace

int glint_sound_read(int descriptor, int (*take)(void*, const int16_t*, size_t), void* user,
                     char* cause, size_t cause_size) {
    SF_INFO info{};
    const std::unique_ptr<SNDFILE, CloseFile> file(
        sf_open_fd(descriptor, SFM_READ, &info, SF_FALSE));
    if (!file) return give_up(sf_strerror(nullptr), cause, cause_size);
    // A FLAC that was written to a pipe does not say.
    const bool is_told = info.frames < SF_COUNT_MAX;
    if (is_told && static_cast<double>(info.frames) > kLongest * info.samplerate)
        return give_up("It is longer than an hour", cause, cause_size);
    Taker taker(info.samplerate, take, user);
    if (!taker.can_resample()) return give_up("Its sample rate is out of range", cause, cause_size);

    constexpr sf_count_t kBlock = 4096;
    const auto channels = static_cast<size_t>(info.channels);
    std::vector<float> values(kBlock * channels), pairs;
    sf_count_t read = 0;
    do {
        read = sf_readf_float(file.get(), values.data(), kBlock);
        pairs.clear();
        for (size_t i = 0; i < static_cast<size_t>(read); ++i) {
            pairs.push_back(values[i * channels]);
            pairs.push_back(values[i * channels + (channels > 1 ? 1 : 0)]);
        }
        if (!taker.put(pairs, read < kBlock)) return give_up("It is too long", cause, cause_size);
    } while (read == kBlock);
    if (sf_error(file.get()) != SF_ERR_NO_ERROR)
        return give_up(sf_strerror(file.get()), cause, cause_size);
    return 1;
}

void* glint_sound_open(int descriptor, const char* format, char* cause, size_t cause_size) {
    const std::string kind = format;
    SF_INFO info{};
    info.samplerate = kRate;
    info.channels = 2;
    info.format = kind == "ogg"    ? SF_FORMAT_OGG | SF_FORMAT_VORBIS
                  : kind == "flac" ? SF_FORMAT_FLAC | SF_FORMAT_PCM_16
                                   : SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    SF_VIRTUAL_IO io{length_of, seek, read_back, write_out, place_of};
    auto writer = std::make_unique<Writer>();
    writer->descriptor = descriptor;
    writer->is_ogg = kind == "ogg";
    writer->file = sf_open_virtual(&io, SFM_WRITE, &info, writer.get());
    if (!writer->file) {
        give_up(sf_strerror(nullptr), cause, cause_size);
        return nullptr;
    }
    double quality = 0.6;  // about 192 kbit/s
    if (kind == "ogg")
        sf_command(writer->file, SFC_SET_VBR_ENCODING_QUALITY, &quality, sizeof quality);
    return writer.release();
}

// In small blocks: the Vorbis encoder keeps each on the stack.
void glint_sound_append(void* user, const int16_t* pairs, size_t count) {
    Writer& writer = *static_cast<Writer*>(user);
    for (size_t done = 0; done < count && writer.error == 0; done += 4096) {
        const size_t block = std::min<size_t>(count - done, 4096);
        sf_writef_short(writer.file, pairs + 2 * done, static_cast<sf_count_t>(block));
    }
}

int glint_sound_close(void* user) {
    const std::unique_ptr<Writer> writer(static_cast<Writer*>(user));
    sf_close(writer->file);
    if (writer->is_ogg && writer->error == 0) number_pages(*writer);
    return writer->error;
}

void glint_spectrum(const float* values, float* magnitudes) {
    static const kiss_fftr_cfg plan = kiss_fftr_alloc(kFftSize, 0, nullptr, nullptr);
    std::array<kiss_fft_cpx, kFftSize / 2 + 1> bins;
    kiss_fftr(plan, values, bins.data());
    for (size_t i = 0; i < kBins; ++i)
        magnitudes[i] = std::sqrt(bins[i].r * bins[i].r + bins[i].i * bins[i].i) / kFftSize;
}
