/* What one rebec can do by itself: its bodies run once for each local state, and are remembered. */
#ifndef REBSYNC_OUTCOMES_H
#define REBSYNC_OUTCOMES_H

#include "components.h"
#include "endless.h"

enum { CONSTRUCTS = -2, RESUMES = -1 };

static struct outcome *outcome(struct engine *e, size_t number)
{
    return (struct outcome *)e->outcomes.data + number;
}

static struct outcome *new_outcome(struct engine *e, int32_t shared)
{
    struct outcome *made = added(e, &e->outcomes, sizeof *made);
    memset(made, 0, sizeof *made);
    made->shared = shared;
    made->component = NONE;
    made->sends = (uint32_t)e->sends.count;
    return made;
}

/* --- one run */

static void room_for_stack(struct engine *e, size_t cells)
{
    struct machine *m = &e->machine;
    if (!enough((void **)&m->stack, &m->stack_room, cells, sizeof(cell)))
        give_up(e);
}

static void start(struct engine *e, int32_t body, const cell *arguments, size_t count)
{
    struct machine *m = &e->machine;
    const struct body *b = e->model->body + body;
    room_for_stack(e, b->need);
    memset(m->stack, 0, b->frame * sizeof(cell));
    if (count)
        memcpy(m->stack, arguments, count * sizeof(cell));
    m->base = 0;
    m->pc = b->entry;
}

/* Lays out the frames of a suspended body again. */
static void resume(struct engine *e, const struct local *l)
{
    struct machine *m = &e->machine;
    const cell *from = l->frames;
    size_t base = 0;
    for (size_t i = 0; i < l->frame_count; i++) {
        int32_t pc = (int32_t)from[0];
        size_t count = (size_t)from[1], live = e->model->live[pc - 1];
        const struct body *b = e->model->body + e->model->body_of[pc - 1];
        room_for_stack(e, base + b->need);
        memset(m->stack + base, 0, b->frame * sizeof(cell));
        memcpy(m->stack + base, from + 2, live * sizeof(cell));
        memcpy(m->stack + base + b->frame, from + 2 + live, (count - live) * sizeof(cell));
        if (i + 1 < l->frame_count) {
            if (!enough((void **)&m->frames, &m->frames_room, m->depth + 1, sizeof *m->frames))
                give_up(e);
            m->frames[m->depth].pc = pc;
            m->frames[m->depth++].base = base;
        }
        m->base = base;
        m->pc = pc;
        base += b->frame + count - live;
        from += 2 + count;
    }
}

/* Keeps the frames of a body that a delay has split: the cells in scope, and operands. */
static void suspend(struct engine *e, struct local *l)
{
    struct machine *m = &e->machine;
    l->frame_count = m->depth + 1;
    l->frame_cells = 0;
    memcpy(l->message, m->message, e->model->stride * sizeof(cell));
    for (size_t i = 0; i < l->frame_count; i++) {
        int last = i == m->depth;
        int32_t pc = last ? m->pc : m->frames[i].pc;
        size_t base = last ? m->base : m->frames[i].base;
        size_t end = last ? m->top : i + 1 == m->depth ? m->base : m->frames[i + 1].base;
        size_t live = e->model->live[pc - 1];
        size_t operands = base + e->model->body[e->model->body_of[pc - 1]].frame;
        size_t count = live + (end - operands);
        room_for_frames(e, l, l->frame_cells + 2 + count);
        cell *to = l->frames + l->frame_cells;
        to[0] = pc;
        to[1] = (cell)count;
        memcpy(to + 2, m->stack + base, live * sizeof(cell));
        memcpy(to + 2 + live, m->stack + operands, (end - operands) * sizeof(cell));
        l->frame_cells += 2 + count;
    }
}

static int run(struct engine *e, uint32_t rebec, const struct local *l, int slot)
{
    struct machine *m = &e->machine;
    const struct rebec *r = e->model->rebec + rebec;
    const cell *message = m->message;
    memcpy(m->variables, l->variables, r->cells * sizeof(cell));
    m->index = (int32_t)rebec;
    m->clock = l->clock;
    m->elapsed = m->delayed = 0;
    m->depth = m->chosen = m->sent = 0;
    m->exhausted = 0;
    begin_count(e);
    m->room = r->capacity - (int64_t)l->messages + (slot >= 0) - (message[SERVER] >= 0);
    if (slot == RESUMES) {
        resume(e, l);
    } else if (slot == CONSTRUCTS) {
        start(e, r->constructor, r->arguments, r->argument_count);
    } else {
        const struct server *s = e->model->server + message[SERVER];
        e->served[message[SERVER]] = 1;
        start(e, s->body, message + ARGUMENTS, s->arguments);
    }
    int status = e->model->run(m);
    if (m->exhausted && m->cause != CHOICES)
        give_up(e);
    return m->exhausted ? ENDLESS : status;
}

/* --- what comes of it */

/* Notes what was sent: to others in the outcome, to the rebec itself into the bag of `l`. */
static void note_sends(struct engine *e, uint32_t rebec, struct local *l, uint32_t made)
{
    struct machine *m = &e->machine;
    for (size_t i = 0; i < m->sent; i++) {
        const cell *sent = m->sends + i * (MESSAGE + m->stride);
        if (sent[RECEIVER] == rebec) {
            insert_message(e, l, sent + MESSAGE);
            continue;
        }
        struct send *s = added(e, &e->sends, sizeof *s);
        s->receiver = (uint32_t)sent[RECEIVER];
        s->choices = (uint32_t)sent[CHOICES_BEFORE];
        s->pc = (uint32_t)sent[SENT_BY];
        s->message = message_number(e, sent + MESSAGE);
        outcome(e, made)->send_count++;
    }
}

static void copy_bag(struct engine *e, struct local *to, const struct local *from, int slot)
{
    size_t size = e->model->stride * sizeof(cell), stride = e->model->stride;
    to->messages = 0;
    room_for_bag(e, to, from->messages);
    for (size_t i = 0; i < from->messages; i++)
        if ((int)i != slot)
            memcpy(to->bag + to->messages++ * stride, from->bag + i * stride, size);
}

/* The instruction at which a run begins, in its outermost frame. */
static uint32_t entry_of(struct engine *e, uint32_t rebec, const struct local *l, int slot)
{
    if (slot == RESUMES)
        return (uint32_t)l->frames[0] - 1;
    int32_t body = slot == CONSTRUCTS ? e->model->rebec[rebec].constructor
                                      : e->model->server[e->machine.message[SERVER]].body;
    return (uint32_t)e->model->body[body].entry;
}

/* Notes where the body was given up that ran last. */
static void note_cut(struct engine *e, uint32_t rebec, const struct local *l, int slot)
{
    const struct machine *m = &e->machine;
    uint32_t pc = (uint32_t)m->pc, outer = m->depth ? (uint32_t)m->frames[0].pc - 1 : pc;
    if (m->cause == CHOICES)
        pc = outer = entry_of(e, rebec, l, slot);
    e->cut = (struct cut){(uint64_t)m->cause, pc, outer};
}

/* One run and its outcome; 0 when the body does not end. The machine's variables are those of
 * e->result. */
static int act_once(struct engine *e, uint32_t rebec, const struct local *l, int slot, int32_t shared)
{
    struct machine *m = &e->machine;
    struct local *after = &e->result;
    int status = run(e, rebec, l, slot);
    if (status == ENDLESS) {
        note_cut(e, rebec, l, slot);
        return 0;
    }
    new_outcome(e, shared);
    uint32_t made = (uint32_t)e->outcomes.count - 1;
    copy_bag(e, after, l, slot);
    note_sends(e, rebec, after, made);
    uint32_t places = (uint32_t)(after->messages + (m->message[SERVER] >= 0));
    if (places > e->actors[rebec].largest)
        e->actors[rebec].largest = places;
    if (status == FAILED) {
        outcome(e, made)->failure = m->failure;
        outcome(e, made)->pc = m->pc;
        return 1;
    }
    after->busy = status == DELAYED ? m->delayed : m->elapsed;
    after->clock = l->clock;
    after->frame_count = after->frame_cells = 0;
    if (status == DELAYED)
        suspend(e, after);
    uint32_t component = number_of(e, rebec, after);
    outcome(e, made)->component = component;
    return 1;
}

/* Runs a body once for each way to choose, the last choice changing first. */
static int act(struct engine *e, uint32_t rebec, const struct local *l, int slot)
{
    struct machine *m = &e->machine;
    int32_t shared = -1;
    m->given = 0;
    for (int32_t ways = 0; ways < WAYS; ways++) {
        if (!act_once(e, rebec, l, slot, shared))
            return 0;
        glance(e, m->slice - m->budget + STORING);
        size_t last = m->chosen;
        while (last && m->choices[last - 1] + 1 == m->options[last - 1])
            last--;
        if (!last)
            return 1;
        m->choices[last - 1]++;
        m->given = last;
        shared = (int32_t)last - 1;
    }
    m->cause = CHOICES;
    note_cut(e, rebec, l, slot);
    return 0;
}

static int serve(struct engine *e, uint32_t rebec, const struct local *l, int slot)
{
    const cell *message = l->bag + (size_t)slot * e->model->stride;
    if (message[DUE] < 0) {
        struct outcome *made = new_outcome(e, -1);
        made->failure = DEADLINE;
        made->pc = e->model->body[e->model->server[message[SERVER]].body].entry;
        return 1;
    }
    e->machine.message = message;
    return act(e, rebec, l, slot);
}

static int serve_candidates(struct engine *e, uint32_t rebec, const struct local *l)
{
    size_t stride = e->model->stride;
    int32_t best = best_priority(e, l);
    if (e->semantics == CORE)
        return serve(e, rebec, l, 0);
    for (size_t i = 0; i < l->messages; i++) {
        const cell *message = l->bag + i * stride;
        if (message[ARRIVAL] != l->bag[ARRIVAL])
            break;
        if (priority_of(e, message[SERVER]) == best && !serve(e, rebec, l, (int)i))
            return 0;
    }
    return 1;
}

/* Finds the outcomes of a component that can act. */
static void produce(struct engine *e, uint32_t rebec, uint32_t id)
{
    struct local *l = &e->scratch;
    size_t outcomes = e->outcomes.count, sends = e->sends.count;
    int ends;
    unpack_local(e, rebec, id, l);
    if (l->frame_count) {
        e->machine.message = l->message;
        ends = act(e, rebec, l, RESUMES);
    } else {
        ends = serve_candidates(e, rebec, l);
    }
    if (!ends) {
        e->outcomes.count = outcomes;
        e->sends.count = sends;
        component(e, rebec, id)->flags |= STUCK;
        return;
    }
    if (e->outcomes.count >= NONE || e->sends.count >= NONE)
        give_up(e);
    outcome(e, e->outcomes.count - 1)->last = 1;
    component(e, rebec, id)->outcomes = (uint32_t)outcomes;
}

/* What the constructor can do in a component whose bag earlier ones have filled; NONE if it
 * does not end. */
static uint32_t construct(struct engine *e, uint32_t rebec, uint32_t id)
{
    struct local *l = &e->scratch;
    uint32_t first = (uint32_t)e->outcomes.count;
    memset(l->message, 0, e->model->stride * sizeof(cell));
    l->message[SERVER] = -1;
    l->message[SENDER] = rebec;
    l->message[DUE] = NO_DEADLINE;
    if (e->model->rebec[rebec].constructor < 0) {
        new_outcome(e, -1)->component = id;
    } else {
        unpack_local(e, rebec, id, l);
        e->machine.message = l->message;
        if (!act(e, rebec, l, CONSTRUCTS))
            return NONE;
    }
    outcome(e, e->outcomes.count - 1)->last = 1;
    return first;
}

#endif
