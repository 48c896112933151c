// paper.cc - the paper's section 3, with Google Benchmark: a soup tested in sequence against one box, again and again, by the
// paper's own test and by every kernel and accuracy; and where the memory, not the arithmetic, is the limit.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/contest.h"
#include "common/machine.h"

namespace
{

constexpr uint64_t seed = 1;

// Scenes that say how the arrangement in memory counts; the program ratios has the others.
constexpr const char *scene_names[] = {"paper", "cache", "memory", "sparse", "sorted"};

bool all_verified = true;

// A scene, made and verified when it is first timed.
class Arena
{
  public:
    Arena(size_t index, const std::vector<contestant> &list) : index_(index), list_(list) {}
    Arena(const Arena &) = delete;
    Arena &operator=(const Arena &) = delete;

    ~Arena()
    {
        if (is_made_)
            scene_free(&scene_);
    }

    bool is_ready()
    {
        if (!is_asked_) {
            is_asked_ = true;
            is_ready_ = make();
            all_verified = all_verified && is_ready_;
        }
        return is_ready_;
    }

    const scene &at() const { return scene_; }
    uint64_t *mask() { return mask_.data(); }
    const score &score_of(size_t c) const { return scores_[c]; }

  private:
    bool make()
    {
        is_made_ = scene_make(index_, seed, &scene_);
        if (!is_made_)
            return false;
        mask_.resize(tribox_mask_words(scene_.soup.count));
        scores_.resize(list_.size());
        if (!contest_verify(list_.data(), list_.size(), &scene_, scores_.data()))
            return false;
        const score &baseline = scores_[0];
        std::fprintf(stderr,
                     "verified %s: EXACT is the same on every kernel; the baseline overlaps %zu, disagrees with EXACT on %zu\n",
                     scene_.name, baseline.overlapping, baseline.of_all.missed + baseline.of_all.untrue);
        return true;
    }

    size_t index_;
    const std::vector<contestant> &list_;
    scene scene_{};
    std::vector<uint64_t> mask_;
    std::vector<score> scores_;
    bool is_asked_ = false, is_made_ = false, is_ready_ = false;
};

void time_contestant(benchmark::State &state, Arena &arena, const contestant &one, size_t c)
{
    if (!arena.is_ready()) {
        state.SkipWithError("the scene could not be made or verified");
        return;
    }
    for (auto _ : state) {
        contest_run(&one, &arena.at(), arena.mask());
        benchmark::ClobberMemory();
    }
    using benchmark::Counter;
    const auto count = static_cast<double>(arena.at().soup.count);
    const double tested = count * static_cast<double>(state.iterations());
    state.SetItemsProcessed(static_cast<int64_t>(tested));
    state.counters["time/triangle"] = Counter(tested, Counter::kIsRate | Counter::kInvert);
    state.counters["bytes/triangle"] = sizeof(float) * 9;
    state.counters["undecided%"] = 100 * static_cast<double>(arena.score_of(c).undecided) / count;
}

std::vector<std::unique_ptr<Arena>> open_arenas(const std::vector<contestant> &list)
{
    std::vector<std::unique_ptr<Arena>> arenas;
    for (const char *name : scene_names)
        for (size_t index = 0; index < scene_count(); index++)
            if (std::string(name) == scene_name(index))
                arenas.push_back(std::make_unique<Arena>(index, list));
    return arenas;
}

void register_all(const std::vector<std::unique_ptr<Arena>> &arenas, const std::vector<contestant> &list)
{
    size_t s = 0;
    for (const auto &arena : arenas) {
        const std::string scene = scene_names[s++];
        for (size_t c = 0; c < list.size(); c++)
            benchmark::RegisterBenchmark((scene + "/" + list[c].name).c_str(), [&arena = *arena, &one = list[c],
                                                                                c](benchmark::State &state) {
                time_contestant(state, arena, one, c);
            })->Unit(benchmark::kMicrosecond);
    }
}

void describe_machine()
{
    const machine here = machine_here();
    benchmark::AddCustomContext("processor", here.processor);
    benchmark::AddCustomContext("virtual machine", here.is_virtual ? "yes" : "not seen");
    benchmark::AddCustomContext("compiler", here.compiler);
    benchmark::AddCustomContext("flags", here.flags);
    benchmark::AddCustomContext("commit", here.commit);
}

} // namespace

int main(int argc, char **argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    std::vector<contestant> list(CONTESTANTS_MAX);
    list.resize(contest_enter(list.data()));
    const auto arenas = open_arenas(list);
    register_all(arenas, list);
    describe_machine();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return all_verified ? 0 : 1;
}
