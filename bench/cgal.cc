// cgal.cc - the peer that is exact too: CGAL's do_intersect of a triangle and a box, on the same pairs. Answers have to be equal
// for every triangle that is not degenerate, which CGAL asks for; then the speeds are compared, interleaved in one process.
//
// The predicates of both its kernels are exact. With a Bbox_3, CGAL answers most pairs by a filter in floating point; with an
// Iso_cuboid_3, by interval arithmetic; what these leave, in exact numbers. Triangles and boxes are made before the clock runs.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

extern "C" {
#include "console/json.h"
#include "console/message.h"
#include "console/option_reader.h"
}

#include "common/entries.h"
#include "common/header.h"
#include "common/soups.h"
#include "common/whole.h"

namespace
{

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel; // of constructions: do_intersect has none
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

constexpr const char *scene_names[] = {"paper",        "sparse", "cad",     "cad-tenths", "touching",
                                       "touching-ulp", "offset", "needles", "caps"};

// How many times as fast as CGAL EXACT of avx2 is to be, with CGAL's exact kernels, on the scene of the paper.
constexpr double goal = 80;

// Of a scene the first triangles: CGAL takes seconds for all of them where it needs exact numbers.
constexpr size_t triangles_most = 16384;

class Peer
{
  public:
    virtual ~Peer() = default;
    virtual void answer(uint64_t *mask) const = 0;
    virtual bool is_degenerate(size_t i) const = 0;

    static bool run(const contestant *self, uint64_t *mask, tribox_report *)
    {
        static_cast<const Peer *>(self->question)->answer(mask);
        return true;
    }
};

template <class Kernel> CGAL::Bbox_3 make_box(const tribox_box &b, const CGAL::Bbox_3 *)
{
    return {b.lo[0], b.lo[1], b.lo[2], b.hi[0], b.hi[1], b.hi[2]};
}

template <class Kernel> typename Kernel::Iso_cuboid_3 make_box(const tribox_box &b, const typename Kernel::Iso_cuboid_3 *)
{
    using Point = typename Kernel::Point_3;
    return {Point(b.lo[0], b.lo[1], b.lo[2]), Point(b.hi[0], b.hi[1], b.hi[2])};
}

template <class Kernel, class Box> class CgalPeer : public Peer
{
  public:
    explicit CgalPeer(const timing_job &job) : box_(make_box<Kernel>(job.box, static_cast<const Box *>(nullptr)))
    {
        using Point = typename Kernel::Point_3;
        for (size_t i = 0; i < job.soup.count; i++) {
            const float(*u)[3] = job.triangles[i];
            triangles_.emplace_back(Point(u[0][0], u[0][1], u[0][2]), Point(u[1][0], u[1][1], u[1][2]),
                                    Point(u[2][0], u[2][1], u[2][2]));
        }
    }

    void answer(uint64_t *mask) const override
    {
        for (size_t first = 0; first < triangles_.size(); first += 64) {
            const size_t end = std::min(first + 64, triangles_.size());
            uint64_t word = 0;
            for (size_t i = first; i < end; i++)
                word |= static_cast<uint64_t>(CGAL::do_intersect(triangles_[i], box_)) << (i - first);
            mask[first / 64] = word;
        }
    }

    bool is_degenerate(size_t i) const override { return triangles_[i].is_degenerate(); }

  private:
    std::vector<typename Kernel::Triangle_3> triangles_;
    Box box_;
};

struct Entry {
    const char *name;
    std::unique_ptr<Peer> (*make)(const timing_job &);
};

template <class Kernel, class Box> std::unique_ptr<Peer> make_peer(const timing_job &job)
{
    return std::make_unique<CgalPeer<Kernel, Box>>(job);
}

constexpr Entry entries[] = {
    {"cgal-epick-bbox", make_peer<Inexact, CGAL::Bbox_3>},
    {"cgal-epick-cuboid", make_peer<Inexact, Inexact::Iso_cuboid_3>},
    {"cgal-epeck-bbox", make_peer<Exact, CGAL::Bbox_3>},
    {"cgal-epeck-cuboid", make_peer<Exact, Exact::Iso_cuboid_3>},
};

// EXACT of every kernel, then the peers.
struct Field {
    std::vector<contestant> list;
    std::vector<std::unique_ptr<Peer>> peers;
};

Field enter(const scene &at)
{
    Field field;
    contestant all[CONTESTANTS_MAX];
    const size_t count = contestants_enter(&at.work, all);
    for (size_t c = 0; c < count; c++)
        if (all[c].promise == PROMISE_EXACT)
            field.list.push_back(all[c]);
    for (const Entry &entry : entries) {
        contestant one{};
        std::snprintf(one.name, sizeof one.name, "%s", entry.name);
        field.peers.push_back(entry.make(at.work.jobs[0]));
        one.run = Peer::run;
        one.question = field.peers.back().get();
        one.promise = PROMISE_ROUNDED; // of degenerate triangles CGAL promises nothing
        one.pairs = static_cast<double>(at.work.pairs);
        field.list.push_back(one);
    }
    return field;
}

struct Disagreement {
    size_t proper = 0, degenerate = 0; // triangles
};

Disagreement compare(const Peer &peer, const std::vector<uint64_t> &exact, size_t count)
{
    Disagreement found;
    std::vector<uint64_t> answer(exact.size());
    peer.answer(answer.data());
    for (size_t i = 0; i < count; i++)
        if ((exact[i / 64] ^ answer[i / 64]) >> (i % 64) & 1)
            ++(peer.is_degenerate(i) ? found.degenerate : found.proper);
    return found;
}

size_t count_degenerate(const Peer &peer, size_t count)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        found += peer.is_degenerate(i);
    return found;
}

// Whether EXACT is the same on all kernels and CGAL agrees with it on every triangle that is not degenerate.
bool verify(const Field &field, const scene &at)
{
    const size_t count = at.work.pairs;
    const truth from = truth_of_work(&at.work);
    std::vector<score> scores(field.list.size());
    std::vector<uint64_t> exact(at.work.words);
    if (!entries_verify(field.list.data(), field.list.size(), at.name, &from, scores.data()) ||
        !contestant_truth(&at.work, TRIBOX_AXES_ALL, exact.data()))
        return false;
    std::printf("\nscene %s: %zu triangles, %s; %zu degenerate\n", at.name, count, at.what,
                count_degenerate(*field.peers[0], count));
    bool is_right = true;
    for (size_t p = 0; p < field.peers.size(); p++) {
        const Disagreement found = compare(*field.peers[p], exact, count);
        if (found.proper || found.degenerate)
            std::printf("%-20s unlike EXACT on %zu triangles that are not degenerate, and on %zu that are\n", entries[p].name,
                        found.proper, found.degenerate);
        is_right = is_right && found.proper == 0;
    }
    if (is_right)
        std::printf("equal answers of EXACT and CGAL on all that are not degenerate\n");
    return is_right;
}

// The ratio of two contestants' times, paired within the rounds; in brackets that of their least.
void print_times(const samples &taken, size_t of, size_t to)
{
    const double by_least = measure_spread(&taken, of).least / measure_spread(&taken, to).least;
    std::printf(" %9.1f (%8.1f)", measure_ratio(&taken, of, to).median, by_least);
}

size_t index_of(const Field &field, const char *name)
{
    for (size_t c = 0; c < field.list.size(); c++)
        if (!std::strcmp(field.list[c].name, name))
            return c;
    return 0;
}

void print_goal(const Field &field, const samples &taken, const char *peer)
{
    const double times = measure_ratio(&taken, index_of(field, peer), index_of(field, "avx2-exact")).median;
    std::printf("goal: avx2-exact at least %.0f times the speed of %s: %s, %.1f\n", goal, peer,
                times >= goal ? "reached" : "NOT reached", times);
}

void time_scene(const Field &field, const scene &at, const effort &how, generator *order)
{
    static samples taken;
    std::vector<uint64_t> mask(at.work.words);
    const size_t widest = 0, avx2 = index_of(field, "avx2-exact");
    measure(field.list.data(), field.list.size(), how, order, mask.data(), &taken);
    std::printf("%-20s %9s %9s   %-30s\n", "", "ns per", "triangle", "times the time of, by median (by least)");
    std::printf("%-20s %9s %9s   %19s  %19s\n", "contestant", "median", "least", field.list[widest].name, field.list[avx2].name);
    for (size_t c = 0; c < field.list.size(); c++) {
        const spread time = measure_spread(&taken, c);
        std::printf("%-20s %9.2f %9.2f  ", field.list[c].name, time.median, time.least);
        print_times(taken, c, widest);
        print_times(taken, c, avx2);
        std::printf("\n");
    }
    if (!std::strcmp(at.name, "paper") && avx2 != widest)
        for (const Entry &entry : entries)
            print_goal(field, taken, entry.name);
    measure_warn_if_disturbed(stdout, &taken);
    std::fflush(stdout);
}

struct Settings {
    const char *scene = nullptr; // for all
    bool is_timed = true;
    uint64_t seed = 1;
    effort how{15, 3, 2e-3};
};

bool run_scene(const char *name, const Settings &s, generator *order)
{
    size_t index;
    scene at;
    if (!scene_find(name, &index) || !scene_make(index, s.seed, &at))
        return false;
    timing_work_shorten(&at.work, triangles_most);
    bool is_right;
    {
        const Field field = enter(at);
        is_right = verify(field, at);
        if (is_right && s.is_timed)
            time_scene(field, at, s.how, order);
    }
    scene_free(&at);
    return is_right;
}

constexpr const char *usage = "Usage: cgal [--verify] [--scene NAME] [--rounds N] [--seed N]\n"
                              "Compares EXACT with CGAL's do_intersect on the same triangles: answers, then speed.\n"
                              "  --verify       answers alone\n"
                              "  --scene NAME   one scene; without it nine of them, in a minute\n"
                              "  --rounds N     measure N rounds, 5 to 1000, however long they take\n"
                              "  --seed N       of the scenes and of the order within the rounds\n";

enum { OPTION_VERIFY, OPTION_SCENE, OPTION_ROUNDS, OPTION_SEED };

constexpr option_entry options[] = {
    {"verify", 0, false}, {"scene", 's', true}, {"rounds", 'r', true}, {"seed", 0, true}, {nullptr, 0, false}};

extern "C" int take(void *request, int which, const char *value)
{
    Settings &s = *static_cast<Settings *>(request);
    size_t index;
    uint64_t rounds;
    switch (which) {
    case OPTION_VERIFY:
        s.is_timed = false;
        return EXIT_CODE_OK;
    case OPTION_SCENE:
        s.scene = value;
        return scene_find(value, &index) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    case OPTION_ROUNDS:
        if (whole_read(value, "rounds", MEASURE_LEAST, MEASURE_MOST, &rounds))
            return EXIT_CODE_USAGE;
        s.how = {static_cast<size_t>(rounds), 1e9, 2e-3};
        return EXIT_CODE_OK;
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s.seed);
    default:
        return message_usage("unexpected '%s'", value);
    }
}

} // namespace

int main(int argc, char **argv)
{
    Settings s;
    options_found found;
    message_set_program("cgal");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return std::fputs(usage, stdout) < 0;
    const run r = {argc, argv, s.seed, machine_here()};
    header_text(stdout, "", &r);
    std::printf("CGAL       %s, in C++17 with -O3 and without its assertions\n", CGAL_VERSION_STR);
    generator order = {~s.seed};
    bool is_right = true;
    for (const char *name : scene_names)
        if (!s.scene || !std::strcmp(s.scene, name))
            is_right = run_scene(name, s, &order) && is_right;
    return is_right ? 0 : 1;
}
