/* What one rebec can do by itself: its bodies run once for each local state, and are remembered. */
#ifndef REBSYNC_OUTCOMES_H
#define REBSYNC_OUTCOMES_H

#include "components.h"
#include "endless.h"

enum { CONSTRUCTS = -2, RESUMES = -1 };

static struct outcome *outcome(struct kernel *k, size_t number)
{
    return (struct outcome *)k->outcomes.data + number;
}

static struct outcome *new_outcome(struct kernel *k, int32_t shared)
{
    struct outcome *made = added(k->escape, &k->outcomes, sizeof *made);
    memset(made, 0, sizeof *made);
    made->shared = shared;
    made->component = NONE;
    made->sends = (uint32_t)k->sends.count;
    return made;
}

/* --- one run */

static void room_for_stack(struct kernel *k, size_t cells)
{
    struct machine *m = &k->machine;
    if (!enough((void **)&m->stack, &m->stack_room, cells, sizeof(cell)))
        give_up(k->escape);
}

static void start(struct kernel *k, int32_t body, const cell *arguments, size_t count)
{
    struct machine *m = &k->machine;
    const struct body *b = k->model->body + body;
    room_for_stack(k, b->need);
    memset(m->stack, 0, b->frame * sizeof(cell));
    if (count)
        memcpy(m->stack, arguments, count * sizeof(cell));
    m->base = 0;
    m->pc = b->entry;
}

/* Lays out the frames of a suspended body again. */
static void resume(struct kernel *k, const struct local *l)
{
    struct machine *m = &k->machine;
    const cell *from = l->frames;
    size_t base = 0;
    for (size_t i = 0; i < l->frame_count; i++) {
        int32_t pc = (int32_t)from[0];
        size_t count = (size_t)from[1], live = k->model->live[pc - 1];
        const struct body *b = k->model->body + k->model->body_of[pc - 1];
        room_for_stack(k, base + b->need);
        memset(m->stack + base, 0, b->frame * sizeof(cell));
        memcpy(m->stack + base, from + 2, live * sizeof(cell));
        memcpy(m->stack + base + b->frame, from + 2 + live, (count - live) * sizeof(cell));
        if (i + 1 < l->frame_count) {
            if (!enough((void **)&m->frames, &m->frames_room, m->depth + 1, sizeof *m->frames))
                give_up(k->escape);
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
static void suspend(struct kernel *k, struct local *l)
{
    struct machine *m = &k->machine;
    l->frame_count = m->depth + 1;
    l->frame_cells = 0;
    memcpy(l->message, m->message, k->model->stride * sizeof(cell));
    for (size_t i = 0; i < l->frame_count; i++) {
        int last = i == m->depth;
        int32_t pc = last ? m->pc : m->frames[i].pc;
        size_t base = last ? m->base : m->frames[i].base;
        size_t end = last ? m->top : i + 1 == m->depth ? m->base : m->frames[i + 1].base;
        size_t live = k->model->live[pc - 1];
        size_t operands = base + k->model->body[k->model->body_of[pc - 1]].frame;
        size_t count = live + (end - operands);
        room_for_frames(k, l, l->frame_cells + 2 + count);
        cell *to = l->frames + l->frame_cells;
        to[0] = pc;
        to[1] = (cell)count;
        memcpy(to + 2, m->stack + base, live * sizeof(cell));
        memcpy(to + 2 + live, m->stack + operands, (end - operands) * sizeof(cell));
        l->frame_cells += 2 + count;
    }
}

static int run_once(struct kernel *k, uint32_t rebec, const struct local *l, int slot)
{
    struct machine *m = &k->machine;
    const struct rebec *r = k->model->rebec + rebec;
    const cell *message = m->message;
    memcpy(m->variables, l->variables, r->cells * sizeof(cell));
    m->index = (int32_t)rebec;
    m->clock = l->clock;
    m->elapsed = m->delayed = 0;
    m->depth = m->chosen = m->sent = 0;
    m->exhausted = 0;
    begin_count(k);
    m->room = r->capacity - (int64_t)l->messages + (slot >= 0) - (message[SERVER] >= 0);
    if (slot == RESUMES) {
        resume(k, l);
    } else if (slot == CONSTRUCTS) {
        start(k, r->constructor, r->arguments, r->argument_count);
    } else {
        const struct server *s = k->model->server + message[SERVER];
        k->served[message[SERVER]] = 1;
        start(k, s->body, message + ARGUMENTS, s->arguments);
    }
    int status = k->model->run(m);
    if (m->exhausted && m->cause != CHOICES)
        give_up(k->escape);
    return m->exhausted ? ENDLESS : status;
}

/* --- what comes of it */

/* Notes what was sent: to others in the outcome, to the rebec itself into the bag of `l`. */
static void note_sends(struct kernel *k, uint32_t rebec, struct local *l, uint32_t made)
{
    struct machine *m = &k->machine;
    for (size_t i = 0; i < m->sent; i++) {
        const cell *sent = m->sends + i * (MESSAGE + m->stride);
        if (sent[RECEIVER] == rebec) {
            insert_message(k, l, sent + MESSAGE);
            continue;
        }
        struct send *s = added(k->escape, &k->sends, sizeof *s);
        s->receiver = (uint32_t)sent[RECEIVER];
        s->choices = (uint32_t)sent[CHOICES_BEFORE];
        s->pc = (uint32_t)sent[SENT_BY];
        s->message = message_number(k, sent + MESSAGE);
        outcome(k, made)->send_count++;
    }
}

static void copy_bag(struct kernel *k, struct local *to, const struct local *from, int slot)
{
    size_t size = k->model->stride * sizeof(cell), stride = k->model->stride;
    to->messages = 0;
    room_for_bag(k, to, from->messages);
    for (size_t i = 0; i < from->messages; i++)
        if ((int)i != slot)
            memcpy(to->bag + to->messages++ * stride, from->bag + i * stride, size);
}

/* The instruction at which a run begins, in its outermost frame. */
static uint32_t entry_of(struct kernel *k, uint32_t rebec, const struct local *l, int slot)
{
    if (slot == RESUMES)
        return (uint32_t)l->frames[0] - 1;
    int32_t body = slot == CONSTRUCTS ? k->model->rebec[rebec].constructor
                                      : k->model->server[k->machine.message[SERVER]].body;
    return (uint32_t)k->model->body[body].entry;
}

/* Notes where the body was given up that ran last. */
static void note_cut(struct kernel *k, uint32_t rebec, const struct local *l, int slot)
{
    const struct machine *m = &k->machine;
    uint32_t pc = (uint32_t)m->pc, outer = m->depth ? (uint32_t)m->frames[0].pc - 1 : pc;
    if (m->cause == CHOICES)
        pc = outer = entry_of(k, rebec, l, slot);
    k->cut = (struct cut){(uint64_t)m->cause, pc, outer};
}

/* One run and its outcome; 0 when the body does not end. The machine's variables are those of
 * k->result. */
static int act_once(struct kernel *k, uint32_t rebec, const struct local *l, int slot, int32_t shared)
{
    struct machine *m = &k->machine;
    struct local *after = &k->result;
    int status = run_once(k, rebec, l, slot);
    if (status == ENDLESS) {
        note_cut(k, rebec, l, slot);
        return 0;
    }
    new_outcome(k, shared);
    uint32_t made = (uint32_t)k->outcomes.count - 1;
    copy_bag(k, after, l, slot);
    note_sends(k, rebec, after, made);
    uint32_t places = (uint32_t)(after->messages + (m->message[SERVER] >= 0));
    if (places > k->actors[rebec].largest)
        k->actors[rebec].largest = places;
    if (status == FAILED) {
        outcome(k, made)->failure = m->failure;
        outcome(k, made)->pc = m->pc;
        return 1;
    }
    after->busy = status == DELAYED ? m->delayed : m->elapsed;
    after->clock = l->clock;
    after->frame_count = after->frame_cells = 0;
    if (status == DELAYED)
        suspend(k, after);
    uint32_t component = number_of(k, rebec, after);
    outcome(k, made)->component = component;
    return 1;
}

/* Runs a body once for each way to choose, the last choice changing first. */
static int act(struct kernel *k, uint32_t rebec, const struct local *l, int slot)
{
    struct machine *m = &k->machine;
    int32_t shared = -1;
    m->given = 0;
    for (int32_t ways = 0; ways < WAYS; ways++) {
        if (!act_once(k, rebec, l, slot, shared))
            return 0;
        glance(k, m->slice - m->budget + STORING);
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
    note_cut(k, rebec, l, slot);
    return 0;
}

static int serve(struct kernel *k, uint32_t rebec, const struct local *l, int slot)
{
    const cell *message = l->bag + (size_t)slot * k->model->stride;
    if (message[DUE] < 0) {
        struct outcome *made = new_outcome(k, -1);
        made->failure = DEADLINE;
        made->pc = k->model->body[k->model->server[message[SERVER]].body].entry;
        return 1;
    }
    k->machine.message = message;
    return act(k, rebec, l, slot);
}

static int serve_candidates(struct kernel *k, uint32_t rebec, const struct local *l)
{
    size_t stride = k->model->stride;
    int32_t best = best_priority(k, l);
    if (k->semantics == CORE)
        return serve(k, rebec, l, 0);
    for (size_t i = 0; i < l->messages; i++) {
        const cell *message = l->bag + i * stride;
        if (message[ARRIVAL] != l->bag[ARRIVAL])
            break;
        if (priority_of(k, message[SERVER]) == best && !serve(k, rebec, l, (int)i))
            return 0;
    }
    return 1;
}

/* Finds the outcomes of a component that can act. */
static void produce(struct kernel *k, uint32_t rebec, uint32_t id)
{
    struct local *l = &k->scratch;
    size_t outcomes = k->outcomes.count, sends = k->sends.count;
    int ends;
    unpack_local(k, rebec, id, l);
    if (l->frame_count) {
        k->machine.message = l->message;
        ends = act(k, rebec, l, RESUMES);
    } else {
        ends = serve_candidates(k, rebec, l);
    }
    if (!ends) {
        k->outcomes.count = outcomes;
        k->sends.count = sends;
        component(k, rebec, id)->flags |= STUCK;
        return;
    }
    if (k->outcomes.count >= NONE || k->sends.count >= NONE)
        give_up(k->escape);
    outcome(k, k->outcomes.count - 1)->last = 1;
    component(k, rebec, id)->outcomes = (uint32_t)outcomes;
}

/* What the constructor can do in a component whose bag earlier ones have filled; NONE if it
 * does not end. */
static uint32_t construct(struct kernel *k, uint32_t rebec, uint32_t id)
{
    struct local *l = &k->scratch;
    uint32_t first = (uint32_t)k->outcomes.count;
    memset(l->message, 0, k->model->stride * sizeof(cell));
    l->message[SERVER] = -1;
    l->message[SENDER] = rebec;
    l->message[DUE] = NO_DEADLINE;
    if (k->model->rebec[rebec].constructor < 0) {
        new_outcome(k, -1)->component = id;
    } else {
        unpack_local(k, rebec, id, l);
        k->machine.message = l->message;
        if (!act(k, rebec, l, CONSTRUCTS))
            return NONE;
    }
    outcome(k, k->outcomes.count - 1)->last = 1;
    return first;
}

#endif
