/* The steps of a state: outcomes of those who may act, and the delivery of what they send. */
#ifndef REBSYNC_EXPANSION_H
#define REBSYNC_EXPANSION_H

#include "orbits.h"
#include "outcomes.h"

/* A step to the state e->next, after `time`. */
static void reach(struct engine *e, int32_t actor, int64_t time, int deadlock)
{
    uint64_t code = e->ordinal++ * e->symmetries.order;
    make_canonical(e);
    code += e->turn;
    if (e->purpose <= START) {
        store(e, code, time, deadlock);
        return;
    }
    if (e->purpose == PATH) {
        if (e->found >= 0 || !is_state(e, e->next, e->wanted))
            return;
        int64_t before = e->times.count ? ((int64_t *)e->times.data)[e->current] : 0;
        if (!e->times.count || before + time <= e->until)
            e->found = (int64_t)code;
        return;
    }
    int64_t target = seen(e, e->next);
    if (target < 0)
        return;
    if (e->symmetries.order > 1)
        e->graph.turn[e->edges] = (uint16_t)e->turn;
    e->graph.target[e->edges] = target;
    e->graph.actor[e->edges] = actor;
    e->graph.time[e->edges++] = time;
}

/* A step that fails. */
static void fail(struct engine *e, int32_t actor, int32_t kind, int32_t pc, int32_t rebec)
{
    uint64_t ordinal = e->ordinal++;
    if (e->purpose <= START) {
        store_failure(e, ordinal, kind, pc, rebec);
    } else if (e->purpose == GRAPH) {
        e->graph.target[e->edges] = -1;
        e->graph.actor[e->edges] = actor;
        e->graph.time[e->edges++] = 0;
    }
}

static void pass(struct engine *e, int64_t time)
{
    for (uint32_t r = 0; time > 0 && r < e->rebecs; r++)
        e->next[r] = later(e, r, e->next[r], time);
}

static int64_t least_next(struct engine *e, const uint32_t *ids)
{
    int64_t least = NEVER;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        int64_t next = component(e, r, ids[r])->next;
        least = next < least ? next : least;
    }
    return least;
}

/* The end of a step; the floating view lets time pass in it. */
static void complete(struct engine *e, int32_t actor)
{
    int64_t time = least_next(e, e->next);
    int deadlock = time == NEVER;
    if (deadlock || e->semantics != FTTS)
        time = 0;
    pass(e, time);
    reach(e, actor, time, deadlock);
}

/* Whether a message may take the place of another. */
static int displaces(struct engine *e, uint32_t message)
{
    cell server = ((cell *)e->messages.data)[(size_t)message * e->model->stride + SERVER];
    return server >= 0 && e->model->server[server].depth > 0;
}

/* Delivers what an outcome sends, into e->next; the send that overflows, or NULL. */
static const struct send *deliver(struct engine *e, const struct outcome *o)
{
    for (uint32_t i = 0; i < o->send_count; i++) {
        const struct send *s = (struct send *)e->sends.data + o->sends + i;
        uint32_t receiver = s->receiver, before = e->next[receiver];
        uint32_t capacity = (uint32_t)e->model->rebec[receiver].capacity;
        int full = component(e, receiver, before)->places == capacity;
        if (full && !displaces(e, s->message))
            return s;
        uint32_t after = received(e, receiver, before, s->message);
        if (full && component(e, receiver, after)->places > capacity)
            return s;
        e->next[receiver] = after;
    }
    return NULL;
}

/* What follows an outcome that has left no failure: the step is complete, or the next rebec is
 * constructed. */
static void construct_from(struct engine *e, const uint32_t *ids, uint32_t rebec);

static void follow(struct engine *e, uint32_t rebec)
{
    if (e->purpose != START) {
        complete(e, (int32_t)rebec);
        return;
    }
    uint32_t *ids = malloc(e->rebecs * sizeof *ids);
    if (!ids)
        give_up(e);
    memcpy(ids, e->next, e->rebecs * sizeof *ids);
    construct_from(e, ids, rebec + 1);
    free(ids);
}

/* All outcomes from number `at` on, from a state. A body that fails by an overflow has run only up
 * to there: what it would have chosen afterwards makes no further steps. */
static void follow_all(struct engine *e, const uint32_t *ids, uint32_t rebec, uint32_t at)
{
    int64_t cut = -1;
    for (int last = 0; !last; at++) {
        struct outcome o = *outcome(e, at);
        last = (int)o.last;
        glance(e, STORING);
        if (cut >= 0 && o.shared >= cut)
            continue;
        cut = -1;
        memcpy(e->next, ids, e->rebecs * sizeof *ids);
        const struct send *overflow = deliver(e, &o);
        if (overflow) {
            cut = overflow->choices;
            fail(e, (int32_t)rebec, OVERFLOW, (int32_t)overflow->pc, (int32_t)overflow->receiver);
        } else if (o.failure) {
            fail(e, (int32_t)rebec, o.failure, o.pc, (int32_t)rebec);
        } else {
            e->next[rebec] = o.component;
            follow(e, rebec);
        }
    }
}

static void construct_from(struct engine *e, const uint32_t *ids, uint32_t rebec)
{
    if (rebec == e->rebecs) {
        memcpy(e->next, ids, e->rebecs * sizeof *ids);
        complete(e, -1);
        return;
    }
    uint32_t first = construct(e, rebec, ids[rebec]);
    if (first == NONE)
        longjmp(e->escape, STUCK_AT_START);
    follow_all(e, ids, rebec, first);
}

/* When nobody can act, the exact view lets time pass. */
static void idle(struct engine *e)
{
    int64_t time = e->semantics == TTS ? least_next(e, e->ids) : NEVER;
    if (time == NEVER)
        return;
    memcpy(e->next, e->ids, e->rebecs * sizeof *e->ids);
    pass(e, time);
    reach(e, -1, time, 0);
}

/* Makes sure that the outcomes of a rebec that can act are known; 0 when a body does not end. */
static int know(struct engine *e, uint32_t rebec)
{
    if (component(e, rebec, e->ids[rebec])->outcomes == NONE)
        produce(e, rebec, e->ids[rebec]);
    return !(component(e, rebec, e->ids[rebec])->flags & STUCK);
}

static int fails(struct engine *e, uint32_t rebec)
{
    const struct outcome *o;
    uint32_t at = component(e, rebec, e->ids[rebec])->outcomes;
    do {
        o = outcome(e, at++);
        memcpy(e->next, e->ids, e->rebecs * sizeof *e->ids);
        if (deliver(e, o) || o->failure)
            return 1;
    } while (!o->last);
    return 0;
}

static int is_able(struct engine *e, uint32_t rebec)
{
    return (component(e, rebec, e->ids[rebec])->flags & ABLE) != 0;
}

/* Whether a rebec that can act disturbs another, by the marks of that one. */
static int is_disturbed(struct engine *e, const int32_t *disturbs)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (disturbs[r] && is_able(e, r))
            return 1;
    return 0;
}

/* Lets one rebec act alone whose steps are a persistent set: -1 none is, 0 a body does not end. */
static int expand_persistent(struct engine *e)
{
    for (uint32_t i = 0; i < e->persistent_count; i++) {
        const int32_t *candidate = e->persistent + (size_t)i * (e->rebecs + 1);
        uint32_t r = (uint32_t)candidate[0];
        if (!is_able(e, r) || is_disturbed(e, candidate + 1))
            continue;
        if (!know(e, r))
            return 0;
        if (!fails(e, r)) {
            follow_all(e, e->ids, r, component(e, r, e->ids[r])->outcomes);
            return 1;
        }
    }
    return -1;
}

static int may_act(struct engine *e, uint32_t rebec, int32_t best)
{
    const struct component *c = component(e, rebec, e->ids[rebec]);
    return c->flags & ABLE && c->rank == best;
}

/* The steps of all rebecs of the best rank. */
static int expand_ranked(struct engine *e, int32_t best)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (may_act(e, r, best) && !know(e, r))
            return 0;
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (may_act(e, r, best))
            follow_all(e, e->ids, r, component(e, r, e->ids[r])->outcomes);
    return 1;
}

/* Makes all steps of the state e->ids; 0 when a body in it does not end. */
static int expand(struct engine *e)
{
    int32_t best = INT32_MAX;
    int able = 0;
    e->ordinal = 0;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        const struct component *c = component(e, r, e->ids[r]);
        if (c->flags & ABLE) {
            able = 1;
            best = c->rank < best ? c->rank : best;
        }
    }
    if (!able) {
        idle(e);
        return 1;
    }
    int alone = e->persistent_count ? expand_persistent(e) : -1;
    return alone >= 0 ? alone : expand_ranked(e, best);
}

#endif
