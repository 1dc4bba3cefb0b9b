/* Bodies that are given up; what is looked for is said in endless.py. */
#ifndef REBSYNC_ENDLESS_H
#define REBSYNC_ENDLESS_H

#include "kernel_data.h"

enum { SLICE_OF_BODY = 1 << 20, WATCHED = 1 << 20, SHARE = 8 };

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* The next slice of a body that may still run `left` instructions. */
static void take_slice(struct machine *m, int64_t size)
{
    m->slice = m->budget = least(size, m->left);
    m->left -= m->slice;
}

/* Begins to count the instructions of a run. */
static void begin_count(struct kernel *k)
{
    k->watch.on = 0;
    k->watch.from = WATCHED;
    k->machine.left = k->instructions;
    k->machine.cause = 0;
    take_slice(&k->machine, SLICE_OF_BODY);
}

static int give_up_body(struct machine *m, enum cause cause, int32_t pc)
{
    m->cause = cause;
    m->pc = pc;
    return 0;
}

/* --- whether all comes back to what it was */

static size_t cells_of(const struct kernel *k)
{
    int32_t index = k->machine.index;
    return index < 0 ? 0 : (size_t)k->model->rebec[index].cells;
}

/* Keeps the state before the instruction `pc`; `top` cells of the frame are in use. */
static void remember(struct kernel *k, int32_t pc, size_t top)
{
    struct machine *m = &k->machine;
    struct watch *w = &k->watch;
    size_t variables = cells_of(k), stack = m->base + top;
    w->cells.count = w->frames.count = 0;
    cell *to = (cell *)room_for(k->escape, &w->cells, variables + stack, sizeof(cell));
    memcpy(to, m->stack, stack * sizeof(cell));
    if (variables)
        memcpy(to + stack, m->variables, variables * sizeof(cell));
    struct frame *frames = room_for(k->escape, &w->frames, m->depth, sizeof *frames);
    if (m->depth)
        memcpy(frames, m->frames, m->depth * sizeof *frames);
    w->on = 1;
    w->pc = w->head = pc;
    w->depth = w->shallow = m->depth;
    w->stack = stack;
    w->base = m->base;
    w->chosen = m->chosen;
    w->sent = m->sent;
    w->elapsed = m->elapsed;
}

static int same_frames(const struct kernel *k)
{
    const struct frame *then = (struct frame *)k->watch.frames.data, *now = k->machine.frames;
    for (size_t i = 0; i < k->watch.depth; i++)
        if (then[i].pc != now[i].pc || then[i].base != now[i].base)
            return 0;
    return 1;
}

/* Whether the body goes on as it did from the state that was kept. */
static int repeats(const struct kernel *k, int32_t pc, size_t top)
{
    const struct machine *m = &k->machine;
    const struct watch *w = &k->watch;
    const cell *then = (cell *)w->cells.data;
    size_t variables = cells_of(k);
    return w->pc == pc && w->depth == m->depth && w->base == m->base && w->stack == m->base + top &&
           w->chosen == m->chosen && w->sent == m->sent && w->elapsed == m->elapsed &&
           !memcmp(then, m->stack, w->stack * sizeof(cell)) &&
           !(variables && memcmp(then + w->stack, m->variables, variables * sizeof(cell))) &&
           same_frames(k);
}

/* Notes the head of the outermost loop that was gone through. */
static void note_head(struct watch *w, const struct machine *m, int32_t pc)
{
    if (m->depth < w->shallow || (m->depth == w->shallow && pc < w->head)) {
        w->shallow = m->depth;
        w->head = pc;
    }
}

/* Looks whether the state repeats, in windows that grow with the run; 0 if it does. */
static int compare(struct kernel *k, int64_t done, int32_t pc, size_t top)
{
    struct watch *w = &k->watch;
    if (w->on) {
        note_head(w, &k->machine, pc);
        if (repeats(k, pc, top))
            return 0;
        if (done >= w->to) {
            w->on = 0;
            w->from = 2 * done;
        }
    } else if (done >= w->from) {
        remember(k, pc, top);
        w->to = done + done / SHARE;
    }
    return 1;
}

/* Called at a block of `count` instructions from `pc` on that the slice has no room for: 0 when
 * the body is given up, else it has. */
static int more(struct machine *m, int32_t pc, int32_t count, size_t top)
{
    struct kernel *k = m->kernel;
    if (m->exhausted)
        return 0;
    if (m->left + m->budget < 0)
        return give_up_body(m, INSTRUCTIONS, pc + count + (int32_t)(m->left + m->budget));
    m->left += m->budget;
    glance(k, m->slice - m->budget);
    int64_t done = k->instructions - m->left;
    if (!compare(k, done, pc, top))
        return give_up_body(m, REPEATS, k->watch.head);
    take_slice(m, k->watch.on ? 0 : SLICE_OF_BODY);
    return 1;
}

#endif
