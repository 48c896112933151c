// vdb_part.cc - bricks as the leaves of a tree of OpenVDB's, and the tree as a file.
#include "vdb_part.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>

#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>

namespace
{

// A stream of C's, as one of C++'s.
class c_buffer : public std::streambuf
{
  public:
    explicit c_buffer(FILE *to) : to(to) {}

  protected:
    int overflow(int c) override { return c == traits_type::eof() ? 0 : putc(c, to); }

    std::streamsize xsputn(const char *from, std::streamsize count) override
    {
        return static_cast<std::streamsize>(std::fwrite(from, 1, static_cast<std::size_t>(count), to));
    }

    pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override
    {
        const int whence = from == std::ios_base::beg ? SEEK_SET : from == std::ios_base::cur ? SEEK_CUR : SEEK_END;
        const bool is_question = whence == SEEK_CUR && !by;
        return is_question || !fseeko(to, by, whence) ? pos_type(ftello(to)) : pos_type(off_type(-1));
    }

    pos_type seekpos(pos_type at, std::ios_base::openmode mode) override { return seekoff(off_type(at), std::ios_base::beg, mode); }

  private:
    FILE *to;
};

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

class tree
{
  public:
    virtual ~tree() = default;
    virtual void put(const openvdb::Coord &corner, const uint64_t words[8]) = 0;
    virtual openvdb::GridBase::Ptr base() const = 0;
};

template <class Grid> class tree_of : public tree
{
  public:
    // Made by OpenVDB: to make one here, the compiler would have to translate all of it again.
    tree_of() : grid(std::static_pointer_cast<Grid>(openvdb::GridBase::createGrid(Grid::TreeType::treeType()))) {}

    void put(const openvdb::Coord &corner, const uint64_t words[8]) override
    {
        using leaf_node = typename Grid::TreeType::LeafNodeType;
        typename leaf_node::NodeMaskType mask;
        for (int i = 0; i < 8; i++)
            mask.template getWord<uint64_t>(i) = words[i];
        leaf_node *const leaf = grid->tree().touchLeaf(corner);
        leaf->setValueMask(mask);
        set_values(*leaf, words);
    }

    openvdb::GridBase::Ptr base() const override { return grid; }

  private:
    // The values of a mask are its active cells.
    static void set_values(openvdb::MaskTree::LeafNodeType &, const uint64_t *) {}

    static void set_values(openvdb::BoolTree::LeafNodeType &leaf, const uint64_t words[8])
    {
        std::memcpy(leaf.buffer().data(), words, 8 * sizeof *words);
    }

    typename Grid::Ptr grid;
};

// A value of each cell.
class values
{
  public:
    virtual ~values() = default;
    virtual void put(const openvdb::Coord &corner, const uint64_t bits[8], const uint64_t words[8], const unsigned char *from) = 0;
    virtual openvdb::GridBase::Ptr base() const = 0;
};

template <class Grid> class values_of : public values
{
  public:
    explicit values_of(const typename Grid::ValueType &background)
        : grid(std::static_pointer_cast<Grid>(openvdb::GridBase::createGrid(Grid::TreeType::treeType())))
    {
        grid->tree().root().setBackground(background, false); // of an empty tree
    }

    void put(const openvdb::Coord &corner, const uint64_t bits[8], const uint64_t words[8], const unsigned char *from) override
    {
        using leaf_node = typename Grid::TreeType::LeafNodeType;
        leaf_node *const leaf = grid->tree().touchLeaf(corner);
        typename leaf_node::NodeMaskType mask;
        for (int i = 0; i < 8; i++)
            mask.template getWord<uint64_t>(i) = words[i];
        leaf->setValueMask(mask);
        typename Grid::ValueType *const to = leaf->buffer().data();
        for (unsigned n = 0; n < 512; n++)
            if (bits[n / 64] >> n % 64 & 1) { // of layer z, row y and cell x: OpenVDB counts z first
                std::memcpy(static_cast<void *>(&to[n % 8 * 64 + n / 8 % 8 * 8 + n / 64]), from, sizeof *to);
                from += sizeof *to;
            }
    }

    openvdb::GridBase::Ptr base() const override { return grid; }

  private:
    typename Grid::Ptr grid;
};

// What there is of a file.
struct content {
    std::unique_ptr<tree> cells;          // nullptr: these have ids
    std::unique_ptr<tree> inside;         // nullptr: no labels
    std::unique_ptr<values> cells_values; // nullptr: none
};

// The middle of cell i lies at index i, as programs that draw voxels have it.
openvdb::math::Transform::Ptr transform_of(const vdb_grid &grid)
{
    const openvdb::Vec3d cell(openvdb::Vec3d(grid.cell) * grid.unit), middle(openvdb::Vec3d(grid.origin) * grid.unit + cell / 2.0);
    return openvdb::math::Transform::Ptr(
        new openvdb::math::Transform(openvdb::math::MapBase::Ptr(new openvdb::math::ScaleTranslateMap(cell, middle))));
}

void describe(openvdb::GridBase &to, const vdb_grid &grid, const char *name)
{
    const openvdb::Vec3d shift(grid.shift);
    to.setName(name);
    to.setTransform(transform_of(grid));
    to.setCreator("tribox");
    to.insertMeta("origin", openvdb::Vec3DMetadata(openvdb::Vec3d(grid.origin)));
    to.insertMeta("cell", openvdb::Vec3DMetadata(openvdb::Vec3d(grid.cell)));
    to.insertMeta("size", openvdb::Vec3IMetadata(openvdb::Vec3i(static_cast<int>(grid.size[0]), static_cast<int>(grid.size[1]),
                                                                static_cast<int>(grid.size[2]))));
    to.insertMeta("shift", openvdb::Vec3DMetadata(shift));
    if (grid.unit != 1.0)
        to.insertMeta("unit", openvdb::DoubleMetadata(grid.unit));
}

// Runs something that may throw. Returns whether it did not.
template <class Work> bool attempt(char *reason, Work work)
{
    try {
        work();
        return true;
    } catch (const std::bad_alloc &) {
        std::snprintf(reason, VDB_REASON, "out of memory");
    } catch (const std::exception &e) {
        std::snprintf(reason, VDB_REASON, "%s", e.what());
    }
    return false;
}

void *make(const vdb_grid *grid, char *reason)
{
    content *made = nullptr;
    attempt(reason, [&] {
        openvdb::initialize();
        std::unique_ptr<content> c(new content);
        if (grid->has_ids)
            c->cells_values.reset(new values_of<openvdb::Int32Grid>(-1));
        else if (grid->is_mask)
            c->cells.reset(new tree_of<openvdb::MaskGrid>);
        else
            c->cells.reset(new tree_of<openvdb::BoolGrid>);
        describe(*(grid->has_ids ? c->cells_values->base() : c->cells->base()), *grid, "tribox");
        if (grid->has_labels) {
            c->inside.reset(new tree_of<openvdb::BoolGrid>);
            describe(*c->inside->base(), *grid, "inside");
        }
        if (grid->has_colours) { // light from 0 to 1, as programs that render have it: inactive cells are black
            c->cells_values.reset(new values_of<openvdb::Vec3SGrid>(openvdb::Vec3s(0)));
            c->cells_values->base()->setVectorType(openvdb::VEC_INVARIANT);
            describe(*c->cells_values->base(), *grid, "Cd");
        }
        made = c.release();
    });
    return made;
}

int put(void *to, const uint32_t at[3], const uint64_t bits[8], const uint64_t *inside, const void *of_cells, char *reason)
{
    return attempt(reason, [&] {
        uint64_t words[8], inside_words[8], any = 0;
        content *const c = static_cast<content *>(to);
        const openvdb::Coord corner(static_cast<int>(8 * at[0]), static_cast<int>(8 * at[1]), static_cast<int>(8 * at[2]));
        exchange(bits, words);
        if (c->cells)
            c->cells->put(corner, words);
        for (int k = 0; inside && k < 8; k++)
            any |= inside[k];
        if (any) {
            exchange(inside, inside_words);
            c->inside->put(corner, inside_words);
        }
        if (c->cells_values)
            c->cells_values->put(corner, bits, words, static_cast<const unsigned char *>(of_cells));
    });
}

// Whether the stream failed is for its owner to see.
int write(void *from, FILE *to, int can_seek, char *reason)
{
    return attempt(reason, [&] {
        c_buffer buffer(to);
        std::ostream stream(&buffer);
        content *const c = static_cast<content *>(from);
        openvdb::GridPtrVec grids;
        if (c->cells)
            grids.push_back(c->cells->base());
        if (c->inside)
            grids.push_back(c->inside->base());
        if (c->cells_values)
            grids.push_back(c->cells_values->base());
        archive().write_to(stream, grids, can_seek != 0);
    });
}

} // namespace

extern "C" __attribute__((visibility("default"))) const vdb_part tribox_vdb_part = {make, put, write};
