// vdb_filter.cc - tribox-vdb: bricks from standard input, as vdb_filter.h has them, as the leaves of OpenVDB's trees in a file.
// A program of its own: where memory is short, OpenVDB, the library of its threads and the C library under them may end the process
// that they are in, without a chance to clean up or to say why.
#include "vdb_filter.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <fstream>
#include <iostream>
#include <string>

#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>

namespace
{

// OpenVDB's own File opens its file by name, and does not say when the disk is full.
class archive : public openvdb::io::Archive
{
  public:
    // Masks are never compressed; without this the file would say that it needs a library for it.
    archive() { setCompression(openvdb::io::COMPRESS_ACTIVE_MASK); }

    void write_to(std::ostream &to, const openvdb::GridPtrVec &grids, bool can_seek) const { write(to, grids, can_seek); }
};

// Bit i + 8 j of word k becomes bit k + 8 j of word i: OpenVDB counts z first.
void exchange(const uint64_t bits[8], uint64_t words[8])
{
    for (int i = 0; i < 8; i++) {
        words[i] = 0;
        for (int k = 0; k < 8; k++)
            words[i] |= (bits[k] >> i & UINT64_C(0x0101010101010101)) << k;
    }
}

// A grid that takes bricks.
class taker
{
  public:
    virtual ~taker() = default;
    virtual void put(const vdb_brick &brick, const uint64_t bits[8], const unsigned char *values) = 0;
    openvdb::GridBase::Ptr base;

  protected:
    explicit taker(const openvdb::GridBase::Ptr &base) : base(base) {}
};

template <class Grid> class taker_of : public taker
{
  public:
    // Made by OpenVDB: to make one here, the compiler would have to translate all of it again.
    explicit taker_of(const typename Grid::ValueType &background)
        : taker(openvdb::GridBase::createGrid(Grid::TreeType::treeType())), tree(static_cast<Grid &>(*base).tree())
    {
        tree.root().setBackground(background, false); // of an empty tree
    }

    void put(const vdb_brick &brick, const uint64_t bits[8], const unsigned char *values) override
    {
        uint64_t words[8];
        typename leaf_node::NodeMaskType mask;
        exchange(bits, words);
        for (int i = 0; i < 8; i++)
            mask.template getWord<uint64_t>(i) = words[i];
        leaf_node *const leaf = tree.touchLeaf(openvdb::Coord(corner(brick.at[0]), corner(brick.at[1]), corner(brick.at[2])));
        leaf->setValueMask(mask);
        set_values(*leaf, bits, words, values);
    }

  private:
    using leaf_node = typename Grid::TreeType::LeafNodeType;

    static int corner(uint32_t at) { return static_cast<int>(8 * at); }

    // The values of a mask are its active cells.
    static void set_values(openvdb::MaskTree::LeafNodeType &, const uint64_t *, const uint64_t *, const unsigned char *) {}

    static void set_values(openvdb::BoolTree::LeafNodeType &leaf, const uint64_t *, const uint64_t words[8], const unsigned char *)
    {
        std::memcpy(leaf.buffer().data(), words, 8 * sizeof *words);
    }

    template <class Leaf> static void set_values(Leaf &leaf, const uint64_t bits[8], const uint64_t *, const unsigned char *from)
    {
        auto *const to = leaf.buffer().data();
        for (unsigned n = 0; n < 512; n++)
            if (bits[n / 64] >> n % 64 & 1) { // of layer z, row y and cell x: OpenVDB counts z first
                std::memcpy(static_cast<void *>(&to[n % 8 * 64 + n / 8 % 8 * 8 + n / 64]), from, sizeof *to);
                from += sizeof *to;
            }
    }

    typename Grid::TreeType &tree;
};

// The middle of cell i lies at index i, as programs that draw voxels have it.
openvdb::math::Transform::Ptr transform_of(const vdb_grid &grid)
{
    const openvdb::Vec3d cell(openvdb::Vec3d(grid.cell) * grid.unit), middle(openvdb::Vec3d(grid.origin) * grid.unit + cell / 2.0);
    return openvdb::math::Transform::Ptr(
        new openvdb::math::Transform(openvdb::math::MapBase::Ptr(new openvdb::math::ScaleTranslateMap(cell, middle))));
}

template <class Grid>
std::unique_ptr<taker> make(const vdb_grid &grid, const char *name, const typename Grid::ValueType &background)
{
    std::unique_ptr<taker> made(new taker_of<Grid>(background));
    openvdb::GridBase &to = *made->base;
    to.setName(name);
    to.setTransform(transform_of(grid));
    to.setCreator("tribox");
    to.insertMeta("origin", openvdb::Vec3DMetadata(openvdb::Vec3d(grid.origin)));
    to.insertMeta("cell", openvdb::Vec3DMetadata(openvdb::Vec3d(grid.cell)));
    to.insertMeta("size", openvdb::Vec3IMetadata(openvdb::Vec3i(static_cast<int>(grid.size[0]), static_cast<int>(grid.size[1]),
                                                                static_cast<int>(grid.size[2]))));
    to.insertMeta("shift", openvdb::Vec3DMetadata(openvdb::Vec3d(grid.shift)));
    if (grid.unit != 1.0)
        to.insertMeta("unit", openvdb::DoubleMetadata(grid.unit));
    return made;
}

// What there is of a file.
struct content {
    std::unique_ptr<taker> cells, inside, colours; // nullptr: no labels, no colours

    explicit content(const vdb_grid &grid)
    {
        if (grid.has_ids)
            cells = make<openvdb::Int32Grid>(grid, "tribox", -1);
        else if (grid.is_mask)
            cells = make<openvdb::MaskGrid>(grid, "tribox", false);
        else
            cells = make<openvdb::BoolGrid>(grid, "tribox", false);
        if (grid.has_labels)
            inside = make<openvdb::BoolGrid>(grid, "inside", false);
        if (grid.has_colours) { // light from 0 to 1, as programs that render have it: inactive cells are black
            colours = make<openvdb::Vec3SGrid>(grid, "Cd", openvdb::Vec3s(0));
            colours->base->setVectorType(openvdb::VEC_INVARIANT);
        }
    }
};

bool read(void *to, std::size_t size) { return fread(to, 1, size, stdin) == size; }

// Returns whether it came to the last of them: if not, the program that wrote them has ended.
bool take_bricks(const vdb_grid &grid, content &to)
{
    vdb_brick brick = {};
    uint64_t inside[8] = {0};
    static unsigned char values[512 * 3 * sizeof(float)];
    const std::size_t value_bytes = grid.has_colours ? 3 * sizeof(float) : sizeof(int32_t);
    while (read(&brick, sizeof brick) && brick.values <= 512) {
        if ((grid.has_labels && !read(inside, sizeof inside)) || !read(values, brick.values * value_bytes))
            return false;
        to.cells->put(brick, brick.bits, values);
        if (std::any_of(inside, inside + 8, [](uint64_t word) { return word != 0; }))
            to.inside->put(brick, inside, nullptr);
        if (to.colours)
            to.colours->put(brick, brick.bits, values);
    }
    return brick.values == VDB_LAST;
}

void write(const content &from, std::ostream &to, bool can_seek)
{
    openvdb::GridPtrVec grids;
    for (const taker *one : {from.cells.get(), from.inside.get(), from.colours.get()})
        if (one)
            grids.push_back(one->base);
    archive().write_to(to, grids, can_seek);
    to.flush();
}

int fail(const char *why)
{
    fprintf(stderr, "OpenVDB failed: %s\n", why);
    return EXIT_FAILURE;
}

int fail_to_write()
{
    fprintf(stderr, VDB_ERRNO "%d\n", errno ? errno : EIO);
    return EXIT_FAILURE;
}

// Memory is not given back: to take a large tree apart would be slow, and may throw.
int serve()
{
    vdb_grid grid;
    openvdb::initialize();
    while (read(&grid, sizeof grid)) {
        content &all = *new content(grid);
        std::string path(grid.path_bytes, '\0');
        if (!read(&path[0], path.size()))
            return EXIT_FAILURE;
        const bool is_stdout = path == "-";
        std::filebuf file;
        if (!is_stdout && !path.empty() && !file.open(path, std::ios::in | std::ios::out | std::ios::binary))
            return fail_to_write();
        fputs(VDB_READY, stderr);
        if (path.empty())
            continue;
        if (!take_bricks(grid, all))
            return EXIT_FAILURE;
        std::ostream to(is_stdout ? std::cout.rdbuf() : &file);
        to.exceptions(std::ios::badbit | std::ios::failbit); // at once, as errno says why
        try {
            write(all, to, !is_stdout);
        } catch (const std::ios::failure &) {
            return fail_to_write();
        }
        return is_stdout || file.close() ? EXIT_SUCCESS : fail_to_write();
    }
    return EXIT_SUCCESS;
}

} // namespace

int main()
{
    static char buffer[1 << 16];
    setvbuf(stdin, buffer, _IOFBF, sizeof buffer);
    std::ios::sync_with_stdio(false);
    int status;
    try {
        status = serve();
    } catch (const std::bad_alloc &) {
        status = fail("out of memory");
    } catch (const std::exception &e) {
        status = fail(e.what());
    }
    std::_Exit(status);
}
