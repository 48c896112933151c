/* index_results.c - tables of what was measured of an index. */
#include "index_results.h"

#include <math.h>
#include <stdio.h>

const double box_part[BOX_SIZES] = {0.001, 0.01, 0.1, 0.5};

static double times_linear(const order_result *o, int size, index_form form)
{
    return o->size[size].us[FORM_LINEAR] / o->size[size].us[form];
}

/* Calls by lists of boxes of that size after which order, gathering and build are paid back. */
static double pays_after(const scene_result *r, const order_result *o, int size)
{
    const double us = 1e-3 * (double)r->triangles * (o->cost.order + o->cost.gather + o->cost.build);
    return us / (r->order[ORDER_FILE].size[size].us[FORM_LINEAR] - o->size[size].us[FORM_LIST]);
}

static void print_costs(const scene_result *r)
{
    printf("ns a triangle: reading the streams %.2f\n", r->reading);
    for (int o = 0; o < ORDERS; o++) {
        const order_result *const at = &r->order[o];
        printf("  %-6s  order %5.1f, gather %4.1f, build %.2f (%.2f x reading); paid back after", at->name, at->cost.order,
               at->cost.gather, at->cost.build, at->cost.build / r->reading);
        for (int p = 0; p < BOX_SIZES; p++)
            printf(" %.0f", ceil(pays_after(r, at, p)));
        printf(" lists\n");
    }
}

static void print_row(const order_result *o, int p)
{
    const size_result *const s = &o->size[p];
    printf("%-6s %5.1f %% %9.1f %7.1f %7.1f %8.1f ", o->name, 100 * box_part[p], s->hits, s->nodes, s->asked, s->inside);
    for (int f = 0; f < FORMS; f++)
        printf(" %9.2f", s->us[f]);
    printf(" %9.2f\n", times_linear(o, p, FORM_LIST));
}

static void print_cold(const order_result *o)
{
    printf("cold, %s, us a box:\n", o->name);
    for (int p = 0; p < BOX_SIZES; p++) {
        printf("       %5.1f %%%37s", 100 * box_part[p], "");
        for (int f = 0; f < FORMS; f++)
            printf(" %9.2f", o->size[p].cold[f]);
        printf(" %9.2f\n", o->size[p].cold[FORM_LINEAR] / o->size[p].cold[FORM_LIST]);
    }
}

/* Lists by the soup, and how many times as long others take. */
static void print_meshes(const scene_result *r)
{
    printf("meshes: build, ns a triangle: floats %.2f, doubles %.2f\n", r->mesh_build[0], r->mesh_build[1]);
    for (int p = 0; p < BOX_SIZES; p++) {
        const double *const us = r->mesh[p], soup = us[LIST_OF_SOUP];
        printf(
            "       %5.1f %%  lists, us: soup %.2f, boxes of doubles %.2f (%.2f x), mesh of floats %.2f (%.2f x), of doubles %.2f "
            "(%.2f x)\n",
            100 * box_part[p], soup, us[LIST_OF_WIDE_BOXES], us[LIST_OF_WIDE_BOXES] / soup, us[LIST_OF_MESH],
            us[LIST_OF_MESH] / soup, us[LIST_OF_MESH_IN_DOUBLE], us[LIST_OF_MESH_IN_DOUBLE] / soup);
    }
}

void index_print_scene(const scene_result *r)
{
    printf("\n%s: %zu triangles; the index takes %.3f %% of the streams\n", r->name, r->triangles, 100 * r->memory);
    print_costs(r);
    printf("%-6s %7s %9s %7s %7s %8s ", "order", "box", "hits", "nodes", "asked", "inside");
    for (int f = 0; f < FORMS; f++)
        printf(" %9s", index_form_name((index_form)f));
    printf(" %9s\n", "x linear");
    for (int o = 0; o < ORDERS; o++)
        for (int p = 0; p < BOX_SIZES; p++)
            print_row(&r->order[o], p);
    print_cold(&r->order[ORDER_CUTS]);
    printf("turned boxes, us: list");
    for (int p = 0; p < BOX_SIZES; p++)
        printf(" %.2f", r->turned[p]);
    printf("; tribox_overlap_oriented");
    for (int p = 0; p < BOX_SIZES; p++)
        printf(" %.0f (%.1f x)", r->turned_linear[p], r->turned_linear[p] / r->turned[p]);
    printf("\n");
    for (int k = 0; k < MANY_SIZES; k++)
        printf("lists of %zu boxes of %.1f %%, ns a box: as drawn %.0f, in order %.0f, ordering them %.0f\n", r->many[k].boxes,
               100 * box_part[k], r->many[k].as_drawn, r->many[k].in_order, r->many[k].ordering);
    print_meshes(r);
    fflush(stdout);
}

static void json_size(json *to, const size_result *s, int p)
{
    json_open_object(to, NULL);
    json_number(to, "part", 3, box_part[p]);
    json_number(to, "hits", 6, s->hits);
    json_number(to, "nodes", 6, s->nodes);
    json_number(to, "asked", 6, s->asked);
    json_number(to, "inside", 6, s->inside);
    for (int cold = 0; cold < 2; cold++) {
        json_open_object(to, cold ? "us_cold" : "us");
        for (int f = 0; f < FORMS; f++)
            json_number(to, index_form_name((index_form)f), 6, cold ? s->cold[f] : s->us[f]);
        json_close(to);
    }
    json_close(to);
}

void index_print_json(json *to, const scene_result *r)
{
    json_open_object(to, NULL);
    json_string(to, "scene", r->name);
    json_whole(to, "triangles", r->triangles);
    json_number(to, "memory", 6, r->memory);
    json_number(to, "reading_ns", 6, r->reading);
    json_open_lines(to, "orders");
    for (int o = 0; o < ORDERS; o++) {
        json_open_object(to, r->order[o].name);
        json_number(to, "order_ns", 6, r->order[o].cost.order);
        json_number(to, "gather_ns", 6, r->order[o].cost.gather);
        json_number(to, "build_ns", 6, r->order[o].cost.build);
        json_open_rows(to, "sizes");
        for (int p = 0; p < BOX_SIZES; p++)
            json_size(to, &r->order[o].size[p], p);
        json_close(to);
        json_close(to);
    }
    json_close(to);
    json_open_rows(to, "turned");
    for (int p = 0; p < BOX_SIZES; p++) {
        json_open_object(to, NULL);
        json_number(to, "part", 3, box_part[p]);
        json_number(to, "list_us", 6, r->turned[p]);
        json_number(to, "linear_us", 6, r->turned_linear[p]);
        json_close(to);
    }
    json_close(to);
    json_open_rows(to, "many");
    for (int k = 0; k < MANY_SIZES; k++) {
        json_open_object(to, NULL);
        json_number(to, "part", 3, box_part[k]);
        json_whole(to, "boxes", r->many[k].boxes);
        json_number(to, "as_drawn_ns", 6, r->many[k].as_drawn);
        json_number(to, "in_order_ns", 6, r->many[k].in_order);
        json_number(to, "ordering_ns", 6, r->many[k].ordering);
        json_close(to);
    }
    json_close(to);
    json_open_rows(to, "meshes");
    for (int p = 0; p < BOX_SIZES; p++) {
        json_open_object(to, NULL);
        json_number(to, "part", 3, box_part[p]);
        json_number(to, "soup_us", 6, r->mesh[p][LIST_OF_SOUP]);
        json_number(to, "wide_boxes_us", 6, r->mesh[p][LIST_OF_WIDE_BOXES]);
        json_number(to, "mesh_us", 6, r->mesh[p][LIST_OF_MESH]);
        json_number(to, "mesh_in_double_us", 6, r->mesh[p][LIST_OF_MESH_IN_DOUBLE]);
        json_close(to);
    }
    json_close(to);
    json_number(to, "mesh_build_ns", 6, r->mesh_build[0]);
    json_number(to, "mesh_in_double_build_ns", 6, r->mesh_build[1]);
    json_close(to);
    fflush(to->to);
}
