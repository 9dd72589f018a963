#include "measure/study/study.h"

#include "base/json_text.h"
#include "base/say.h"
#include "base/temporary_file.h"
#include "base/terminal.h"
#include "base/words.h"
#include "measure/rows/flip.h"
#include "measure/study/chosen.h"
#include "measure/study/joint.h"
#include "measure/study/looks.h"
#include "measure/study/measure.h"
#include "measure/study/over.h"
#include "measure/study/page.h"
#include "measure/study/result.h"
#include "measure/study/seed.h"
#include "measure/study/store.h"
#include "measure/study/study_lines.h"
#include "offline/common.h"
#include "offline/named_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

// A scene that is studied: what every picture of it shares.
struct Scenery {
    const StudyOptions& options;
    const Preset& preset;
    Context& context;
    const StudyStore& store;
    MeasureOptions how;
    glm::ivec2 size;  // of what is compared
    std::string name;
    std::string key;  // of all that is the same for its pictures
    StudyLines& lines;
};

void tell(const Scenery& scenery, const Knob& knob, const Study& study, bool done = true) {
    scenery.lines.tell(study, knob, scenery.context.is_software(), done);
}

Values values_of(const Scenery& scenery) {
    return values_of_pass(scenery.how.pass);
}

StudyKey key_of(const Scenery& scenery, const Knob& knob, const KnobValue& value,
                const std::string& kind) {
    return {.name = fmt::format("{}-{}-{}", scenery.name, knob.name, value.text),
            .text = scenery.key + kind + "\n" + key_of_setting(scenery.preset, value.setting)};
}

// A picture that counts as the truth, from an earlier call or drawn now.
struct Reference {
    StudyKey key;
    DrawnPicture drawn{};
    std::string file{};  // seen from the report

    // Beyond that no row can be compared.
    bool is_finite_anywhere(Values values) const {
        return pixels_not_finite(drawn.rgba, values) < drawn.rgba.size() / 4;
    }
};

StudyKey key_of_reference(const Scenery& scenery, const Knob& knob, const KnobValue& value) {
    std::string kind = "reference";
    if (knob.constants) kind += fmt::format(" with constants {}", fmt::join(*knob.constants, " "));
    return key_of(scenery, knob, value, kind);
}

// One of an earlier call.
std::optional<DrawnPicture> kept_picture(const Scenery& scenery, const StudyKey& key) {
    auto picture = scenery.store.picture(key, scenery.size);
    auto cut_pass = scenery.store.cut_pass(key);
    if (!picture || !cut_pass) return std::nullopt;
    return DrawnPicture{std::move(*picture), std::move(*cut_pass)};
}

// The name of its file, seen from the report.
std::string keep(const Scenery& scenery, const StudyKey& key, const DrawnPicture& drawn) {
    scenery.store.keep_cut_pass(key, drawn.cut_pass);
    return scenery.store.keep_picture(key, drawn.rgba, scenery.size);
}

// What drew the last reference of a knob, and draws the next one, too, where all that is constant
// in it is the same: of joint settings, whose references share most of their menus.
struct ReferenceScene {
    std::unique_ptr<MeasuredScene> scene{};
    Setting setting{};

    bool draws(const Knob& knob, const Setting& wanted) const {
        return scene && knob.constants &&
               std::ranges::all_of(*knob.constants, [&](std::size_t tweak) {
                   return setting.values[tweak] == wanted.values[tweak];
               });
    }
};

Reference draw_reference(const Scenery& scenery, const Knob& knob, const KnobValue& value,
                         ReferenceScene& shared) {
    Reference result{.key = key_of_reference(scenery, knob, value)};
    if (auto kept = kept_picture(scenery, result.key)) {
        result.drawn = std::move(*kept);
        result.file = scenery.store.shown_file(result.key);
        return result;
    }
    MeasureOptions how = scenery.how;
    if (knob.constants) {
        how.specialise = false;
        how.constants = *knob.constants;
    }
    if (shared.draws(knob, value.setting)) {
        shared.scene->set(value.setting);
    } else {
        shared.scene =
            std::make_unique<MeasuredScene>(scenery.preset, value.setting, scenery.context, how);
    }
    shared.setting = value.setting;
    result.drawn.rgba = shared.scene->draw_picture();
    result.drawn.cut_pass = shared.scene->cut_pass();
    result.file = keep(scenery, result.key, result.drawn);
    return result;
}

// What the preset has of all that this knob turns.
Setting own_setting(const Preset& preset, const Knob& knob) {
    Setting own{.values = preset.values, .settle = preset.settle};
    if (const auto turned = knob.reference.setting.format)
        own.format = {turned->pass, preset.scene.passes[turned->pass].format};
    return own;
}

using Scenes = std::vector<std::unique_ptr<MeasuredScene>>;  // by row; null where it failed

constexpr const char* kDoesNotCompile = "it does not compile";
constexpr int kWarmUp = 3;  // frames: the driver compiles to machine code at the first draw

bool works_more(const KnobValue& value, const KnobValue& reference) {
    return value.work && reference.work && *value.work > *reference.work;
}

// One row: drawn, as `picture`, and compared. The scene stands ready to be timed.
StudyRow measure_row(const Scenery& scenery, const Knob& knob, const KnobValue& value,
                     const Reference* reference, const StudyKey& key, std::vector<float>& picture,
                     std::unique_ptr<MeasuredScene>& scene) {
    StudyRow row{.value = value.text, .work = value.work};
    try {
        scene = std::make_unique<MeasuredScene>(scenery.preset, value.setting, scenery.context,
                                                scenery.how);
        picture = scene->draw_picture();
    } catch (const Stop&) {
        row.failed = kDoesNotCompile;
        return row;
    }
    if (reference) {
        const Values values = values_of(scenery);
        row.is_reference = value.setting == knob.reference.setting;
        row.error = difference(picture, reference->drawn.rgba, values);
        const std::size_t own = row.error->not_finite - row.error->reference_not_finite;
        if (own > 0) row.failed = fmt::format("diverged: {} pixels are not finite", own);
        if (!reference->drawn.cut_pass.empty() || works_more(value, knob.reference)) {
            const std::string cut = scene->cut_pass();
            if (!cut.empty()) row.failed = loops_cut(cut);
        }
        const std::vector<float> seen =
            flip_map(picture, reference->drawn.rgba, scenery.size, {.values = values});
        row.error->flip = mean_where_finite(seen, reference->drawn.rgba);
        if (!reference->is_finite_anywhere(values)) row.error.reset();
        row.picture = scenery.store.keep_picture(key, picture, scenery.size);
        row.map = scenery.store.keep_map(key, picture, reference->drawn.rgba, scenery.size, values);
        row.flip_map = scenery.store.keep_flip_map(key, seen, scenery.size);
    }
    return row;
}

// How far the pictures of each two rows are from each other.
void tell_apart(const Scenery& scenery, const std::vector<std::vector<float>>& pictures,
                Study& study) {
    const std::size_t count = pictures.size();
    for (StudyRow& row : study.rows) row.apart.assign(count, 0.0);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (pictures[a].empty() || pictures[b].empty()) continue;
            const double rmse = difference(pictures[a], pictures[b], values_of(scenery)).rmse;
            study.rows[a].apart[b] = study.rows[b].apart[a] = rmse;
        }
    }
}

// Makes ready to be timed what an earlier call has drawn.
void open_scene(const Scenery& scenery, const KnobValue& value,
                std::unique_ptr<MeasuredScene>& scene) {
    if (scene) return;
    scene = std::make_unique<MeasuredScene>(scenery.preset, value.setting, scenery.context,
                                            scenery.how);
    scene->draw_picture();
}

void warm_up(MeasuredScene& scene, StudyRow& row) {
    for (int i = 0; i < kWarmUp; ++i) {
        const FrameTime frame = scene.time_frame();
        row.times = {.wall = {frame.wall}, .gpu = {frame.gpu}, .processor = {frame.processor}};
    }
}

// Pictures and errors. What is drawn now has a first time, too, as long as there is no better.
void draw_rows(const Scenery& scenery, const Knob& knob, const Reference* reference, Study& study,
               Scenes& scenes) {
    std::vector<std::vector<float>> pictures;
    Progress progress(fmt::format("{} {}", scenery.name, knob.name),
                      static_cast<long>(knob.values.size()));
    for (const KnobValue& value : knob.values) {
        const std::string kind = fmt::format("row\n{}", reference ? reference->key.text : "");
        const StudyKey key = key_of(scenery, knob, value, kind);
        std::unique_ptr<MeasuredScene>& scene = scenes.emplace_back();
        std::vector<float>& picture = pictures.emplace_back();
        if (auto kept = scenery.store.row(key, scenery.size)) {
            picture = scenery.store.picture(key, scenery.size).value_or(std::vector<float>());
            study.rows.push_back(std::move(*kept));
        } else {
            study.rows.push_back(measure_row(scenery, knob, value, reference, key, picture, scene));
            scenery.store.keep(key, study.rows.back());
            if (scene) warm_up(*scene, study.rows.back());
        }
        study.rows.back().is_preset = value.setting == own_setting(scenery.preset, knob);
        study.rows.back().is_between = value.is_between;
        progress.update(static_cast<long>(study.rows.size()));
        tell(scenery, knob, study);
    }
    if (reference) tell_apart(scenery, pictures, study);
}

StudyKey key_of_times(const Scenery& scenery, const Knob& knob) {
    std::string text = fmt::format("{}times of {} rounds, {} s, on {}\n", scenery.key,
                                   scenery.options.frames, scenery.options.seconds, machine_name());
    for (const KnobValue& value : knob.values) {
        text += key_of_setting(scenery.preset, value.setting);
    }
    return {.name = fmt::format("{}-{}-times", scenery.name, knob.name), .text = text};
}

void take(Study& study, const Rounds& rounds) {
    study.look = rounds.look;
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        study.rows[i].times = rounds.rows[i];
        study.rows[i].all_passes_ms = rounds.all_passes[i];
    }
}

// A time depends on the machine, on how many rounds there were, and on what else was in them.
void time_rows(const Scenery& scenery, const Knob& knob, Study& study, Scenes& scenes) {
    const StudyKey key = key_of_times(scenery, knob);
    const auto kept = scenery.store.rounds(key);
    if (kept && kept->rows.size() == study.rows.size()) {
        take(study, *kept);
        return tell(scenery, knob, study);
    }
    std::vector<std::size_t> rows;  // that can be drawn
    std::size_t anchor = 0;         // of these, the preset's own
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        if (study.rows[i].failed == kDoesNotCompile) continue;
        if (!scenes[i]) {
            open_scene(scenery, knob.values[i], scenes[i]);
            warm_up(*scenes[i], study.rows[i]);
        }
        if (study.rows[i].is_preset) anchor = rows.size();
        rows.push_back(i);
    }
    const RoundsOptions options{.least = scenery.options.frames,
                                .seconds = scenery.options.seconds,
                                .on_software = scenery.context.is_software(),
                                .anchor = anchor};
    Rounds all{.rows = std::vector<FrameTimes>(study.rows.size()),
               .all_passes = std::vector<double>(study.rows.size(), 0.0)};
    const auto spread = [&](const Rounds& rounds) {
        all.look = rounds.look;
        for (std::size_t k = 0; k < rows.size(); ++k) all.rows[rows[k]] = rounds.rows[k];
        take(study, all);
    };
    for (const std::size_t row : rows) scenes[row]->find_quick_place();
    const Rounds rounds = time_rounds(
        rows.size(), [&](std::size_t k) { return scenes[rows[k]]->time_frame(); }, options,
        [&](const Rounds& sofar) {
            spread(sofar);
            tell(scenery, knob, study, false);
        });
    for (const std::size_t row : rows) all.all_passes[row] = scenes[row]->time_all_passes();
    spread(rounds);
    scenery.store.keep(key, all);
    tell(scenery, knob, study);
}

// Draws what counts as the truth, one picture after the other.
struct References {
    const Scenery& scenery;
    const Knob& knob;
    ReferenceScene shared{};
    std::string cut{};  // of what was drawn last

    Reference draw(const KnobValue& value) {
        Reference drawn = draw_reference(scenery, knob, value, shared);
        cut = drawn.drawn.cut_pass;
        return drawn;
    }

    Difference apart(const Reference& a, const Reference& b) const {
        const Values values = values_of(scenery);
        Difference between = difference(a.drawn.rgba, b.drawn.rgba, values);
        between.flip = mean(flip_map(a.drawn.rgba, b.drawn.rgba, scenery.size, {.values = values}));
        return between;
    }

    // Beside `truth`; of twice the work where another seed changes nothing.
    Difference beside(const Reference& truth, std::optional<KnobValue>& second,
                      const std::optional<KnobValue>& more, SecondWork& work) {
        const Difference off = apart(draw(*second), truth);
        if (work.kind != SecondWork::Kind::seed || off.max > 0.0 || !more) return off;
        second = more;
        work = kTwiceTheWork;
        return apart(draw(*second), truth);
    }
};

// Another way to the truth, and what that is off by itself.
void draw_rival(References& references, const Reference& reference, Rival& named, Study& study) {
    const Reference rival = references.draw(named.value);
    study.rival = {.value = named.value.text,
                   .difference = references.apart(rival, reference),
                   .cut = references.cut};
    // What it is off by the order that it has itself, which need not be the reference's.
    const auto by_its_own_fall = [&](double last) {
        if (!named.less || named.work.kind == SecondWork::Kind::seed) return 0.0;
        const Reference least = references.draw(*named.less);
        const Reference second = references.draw(*named.second);
        const bool is_more = named.work.kind == SecondWork::Kind::more;
        const Reference &middle = is_more ? rival : second, &most = is_more ? second : rival;
        const double step = references.apart(least, middle).rmse;
        const double far = references.apart(least, most).rmse;
        return own_error(last, {SecondWork::Kind::more, is_more ? 2.0 : 0.5},
                         fall_by_doubling(step, last, far));
    };
    if (!named.second) return;
    const double rmse = references.beside(rival, named.second, named.more, named.work).rmse;
    study.rival->own_error = std::max(own_error(rmse, named.work, {}), by_its_own_fall(rmse));
}

// What the reference is measured by.
void draw_beside(References& references, const Reference& reference, Knob& knob, Study& study) {
    if (knob.second) {
        const Difference off =
            references.beside(reference, knob.second, knob.more, knob.second_work);
        if (study.reference_not_finite == 0) study.reference_error = off;
        study.second_cut = references.cut;
        study.second = knob.second->text;
        tell(references.scenery, knob, study);
    }
    if (!knob.rival) return;
    draw_rival(references, reference, *knob.rival, study);
    tell(references.scenery, knob, study);
    if (knob.rival->second) tell(references.scenery, knob, study);
}

// The reference, and what it is measured by; none where only times are wanted.
std::optional<Reference> draw_references(const Scenery& scenery, Knob& knob, Study& study) {
    if (study.time_only) return std::nullopt;
    References references{.scenery = scenery, .knob = knob};
    Reference reference = references.draw(knob.reference);
    study.reference_picture = reference.file;
    study.reference_not_finite = pixels_not_finite(reference.drawn.rgba, values_of(scenery));
    study.reference_size = size_of_values(reference.drawn.rgba, values_of(scenery));
    study.reference_cut = references.cut;
    tell(scenery, knob, study);
    draw_beside(references, reference, knob, study);
    return reference;
}

// What the knob's reference turns out to be measured by stands in the knob afterwards.
Study study_knob(const Scenery& scenery, Knob& knob) {
    Study study{.scene = scenery.preset.file.string(),
                .knob = knob.name,
                .reference = knob.reference.text,
                .second = knob.second ? knob.second->text : "",
                .renderer = scenery.context.renderer(),
                .machine = machine_name(),
                .size = scenery.size,
                .pass = scenery.options.pass,
                .time_only = scenery.options.time_only,
                .is_joint = limit_of(scenery.options).has_value(),
                .notes = knob.notes};
    const std::optional<Reference> reference = draw_references(scenery, knob, study);
    Scenes scenes;
    draw_rows(scenery, knob, reference ? &*reference : nullptr, study, scenes);
    if (reference && seed_moves_something_else(study, knob)) {
        measure_by_work(knob);
        References references{.scenery = scenery, .knob = knob};
        draw_beside(references, *reference, knob, study);
    }
    time_rows(scenery, knob, study, scenes);
    judge(study, knob, scenery.context.is_software());
    return study;
}

std::size_t output_of(const Scene& scene, std::size_t pass, const std::string& name) {
    if (pass == kImagePass) return 0;
    const auto& names = scene.passes[pass].outputs;
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

// What a budget chooses from, as the values of one knob.
Knob search_knob(const Scenery& scenery, const std::vector<Knob>& knobs, const Limit& limit) {
    const SearchCaller caller{
        .find =
            [&](const Knob& knob, const KnobValue& value) {
                const StudyKey key = key_of_reference(scenery, knob, value);
                return kept_picture(scenery, key);
            },
        .keep =
            [&](const Knob& knob, const KnobValue& value, const DrawnPicture& drawn) {
                keep(scenery, key_of_reference(scenery, knob, value), drawn);
            },
        .told =
            [&](int tried, int most) {
                if (!scenery.options.lines) return;
                say_result("{}\n", json_text(Json{{"done", tried}, {"of", most}}, -1));
                flush_results();
            }};
    return joint_knob(scenery.preset, knobs, limit, scenery.options.seconds, scenery.context,
                      scenery.how, caller);
}

// What is said of it at the end.
void finish(Study& study, const StudyPlan& plan, const StudyOptions& options) {
    for (const std::string& left_out : plan.left_out)
        study.notes.push_back("left out: " + left_out);
    const bool table = !options.view.json && !options.csv && !options.lines;
    if (table) say_result("{}\n", to_table(study));
    flush_results();
}

// Views have qualities of their own; the file's is the one that is marked.
void mark_own(Study& study, const Preset& preset, const Knob& knob) {
    for (std::size_t i = 0; i < study.rows.size(); ++i)
        study.rows[i].is_preset = knob.values[i].setting == own_setting(preset, knob);
}

// All studies of one file.
void study_file(const std::filesystem::path& file, const StudyOptions& options, Context& context,
                const StudyStore& store, std::vector<Study>& studies) {
    ViewOptions view = options.view;
    view.file = file;
    if (view.size.empty()) view.size = "640x360";
    const Preset preset = open_preset(view);
    const std::size_t pass = find_pass(preset.scene, options.pass);
    const SceneFacts facts = scene_facts(preset, pass);
    StudyPlan plan = plan_study(preset, facts, options);
    const MeasureOptions how{.pass = pass,
                             .output = output_of(preset.scene, pass, options.pass),
                             .specialise = view.specialise};
    const auto limit = limit_of(options);
    const std::vector<View> views = views_over(preset, options);
    Played played(facts.acts);
    std::vector<Played> played_views(views.size(), played);
    StudyLines lines(options.lines);
    const auto scenery = [&](const Preset& seen, const std::string& name, Played& reached) {
        MeasureOptions how_seen = how;
        how_seen.played = &reached;
        return Scenery{
            .options = options,
            .preset = seen,
            .context = context,
            .store = store,
            .how = how_seen,
            .size = compared_size(seen, pass),
            .name = name,
            .key = key_of_preset(seen, context.renderer(), options.pass, view.specialise),
            .lines = lines};
    };
    if (plan.knobs.empty()) say_warning(nothing_to_study(preset, plan));
    const Scenery own = scenery(preset, file.stem().string(), played);
    if (limit) plan.knobs = {search_knob(own, plan.knobs, *limit)};
    lines.expect(plan, options.time_only, std::max<std::size_t>(views.size(), 1));
    for (Knob& knob : plan.knobs) {
        std::vector<Study> seen;
        const Knob planned = knob;  // each view finds out by itself what its second work is
        for (std::size_t v = 0; v < views.size(); ++v) {
            const std::string name = file.stem().string() + "-" + views[v].name;
            Knob turned = knob_in(views[v], preset, planned);
            seen.push_back(study_knob(scenery(views[v].preset, name, played_views[v]), turned));
            knob.second_work = turned.second_work;
            knob.notes = turned.notes;
        }
        if (seen.empty()) {
            studies.push_back(study_knob(own, knob));
        } else {
            studies.push_back(over_all(views, seen));
            studies.back().scene = preset.file.string();
            mark_own(studies.back(), preset, knob);
            judge(studies.back(), knob, context.is_software());
        }
        if (limit) {
            choose_best(studies.back(), *limit);
            lines.tell(studies.back(), knob, context.is_software(), false);
        }
        finish(studies.back(), plan, options);
    }
}

// One object; of a single study its keys stand at the top, too.
Json to_json(const std::vector<Study>& studies, const std::string& renderer) {
    Json json = {{"renderer", renderer}, {"machine", machine_name()}};
    if (studies.size() == 1) json.update(glint::to_json(studies.front()));
    json["studies"] = Json::array();
    for (const Study& study : studies) json["studies"].push_back(glint::to_json(study));
    return json;
}

void require_report_apart(const StudyOptions& options) {
    std::vector<NamedFile> outputs;
    for (const char* name : {"study.csv", "study.json", "index.html"})
        outputs.push_back({"-o", (options.output / name).string()});
    for (const std::filesystem::path& file : options.files) {
        const ReadPreset read = read_preset(file);
        if (read.preset) require_apart(outputs, files_read_for(*read.preset));
    }
    require_own_report(outputs, options.output / "study.json", "studies",
                       "<title>Glint: error against run time<");
}

}  // namespace

void run_study(const StudyOptions& options) {
    if (compares_looks(options)) return run_looks(options);
    const bool to_preset = is_preset(options.output);
    if (limit_of(options) && options.time_only)
        throw UsageError("--metric time tells no error, by which a budget chooses.");
    if (limit_of(options) && options.name != kBest && !to_preset)
        throw UsageError("--name: a preset keeps it; name one with -o FILE.toml.");
    if (!limit_of(options) && options.name != kBest)
        throw UsageError("--name: only what a budget chooses has one; add --ms, --rmse or --flip.");
    if (to_preset) require_preset_output(options);
    if (!to_preset) require_folder(options.output);
    if (!options.output.empty() && !to_preset) require_report_apart(options);
    const auto context = make_egl_context(options.view.device);
    const StudyStore store(to_preset ? std::filesystem::path() : options.output);
    std::vector<Study> studies;
    ExitCode code = ExitCode::done;
    for (const std::filesystem::path& file : options.files) {
        try {
            study_file(file, options, *context, store, studies);
        } catch (const Stop& stop) {  // what is wrong with one file costs no other its report
            if (code == ExitCode::done) code = stop.code;
        }
    }
    std::string csv = csv_header();
    for (const Study& study : studies) csv += to_csv(study);
    if (!options.output.empty() && !to_preset && !studies.empty()) {  // else an older one stays
        const std::string json = json_text(to_json(studies, context->renderer())) + "\n";
        write_whole_file(cleared(options.output / "study.json"), std::as_bytes(std::span(json)));
        write_whole_file(cleared(options.output / "study.csv"), std::as_bytes(std::span(csv)));
        write_page(options.output, studies);
    }
    if (options.csv) say_result("{}", csv);
    if (options.view.json) say_result("{}\n", json_text(to_json(studies, context->renderer())));
    if (to_preset && !studies.empty()) write_best(options, studies);
    if (code != ExitCode::done) throw Stop(code);
}

}  // namespace glint
