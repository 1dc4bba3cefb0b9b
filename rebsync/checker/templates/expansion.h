/* The steps of a state: outcomes of those who may act, and the delivery of what they send. */
#ifndef REBSYNC_EXPANSION_H
#define REBSYNC_EXPANSION_H

#include "orbits.h"
#include "outcomes.h"

/* A step to the state k->next, after `time`. */
static void reach(struct kernel *k, int32_t actor, int64_t time, int deadlock)
{
    uint64_t code = k->ordinal++ * k->symmetries.order;
    make_canonical(k);
    struct transition step = {k->next, code + k->turn, time, actor, deadlock, .turn = k->turn};
    k->visit(k->visitor, &step);
}

/* A step that fails. */
static void fail(struct kernel *k, int32_t actor, int32_t kind, int32_t pc, int32_t rebec)
{
    struct transition step = {NULL, k->ordinal++, 0, actor, 0, kind, pc, rebec, 0};
    k->visit(k->visitor, &step);
}

static void pass(struct kernel *k, int64_t time)
{
    for (uint32_t r = 0; time > 0 && r < k->rebecs; r++)
        k->next[r] = later(k, r, k->next[r], time);
}

static int64_t least_next(struct kernel *k, const uint32_t *ids)
{
    int64_t least = NEVER;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        int64_t next = component(k, r, ids[r])->next;
        least = next < least ? next : least;
    }
    return least;
}

/* The end of a step; the floating view lets time pass in it. */
static void complete(struct kernel *k, int32_t actor)
{
    int64_t time = least_next(k, k->next);
    int deadlock = time == NEVER;
    if (deadlock || k->semantics != FTTS)
        time = 0;
    pass(k, time);
    reach(k, actor, time, deadlock);
}

/* Whether a message may take the place of another. */
static int displaces(struct kernel *k, uint32_t message)
{
    cell server = ((cell *)k->messages.data)[(size_t)message * k->model->stride + SERVER];
    return server >= 0 && k->model->server[server].depth > 0;
}

/* Delivers what an outcome sends, into k->next; the send that overflows, or NULL. */
static const struct send *deliver(struct kernel *k, const struct outcome *o)
{
    for (uint32_t i = 0; i < o->send_count; i++) {
        const struct send *s = (struct send *)k->sends.data + o->sends + i;
        uint32_t receiver = s->receiver, before = k->next[receiver];
        uint32_t capacity = (uint32_t)k->model->rebec[receiver].capacity;
        int full = component(k, receiver, before)->places == capacity;
        if (full && !displaces(k, s->message))
            return s;
        uint32_t after = received(k, receiver, before, s->message);
        if (full && component(k, receiver, after)->places > capacity)
            return s;
        k->next[receiver] = after;
    }
    return NULL;
}

/* What follows an outcome that has left no failure: the step is complete, or the next rebec is
 * constructed. */
static void construct_from(struct kernel *k, const uint32_t *ids, uint32_t rebec);

static void follow(struct kernel *k, uint32_t rebec)
{
    if (!k->starting) {
        complete(k, (int32_t)rebec);
        return;
    }
    uint32_t *ids = malloc(k->rebecs * sizeof *ids);
    if (!ids)
        give_up(k->escape);
    memcpy(ids, k->next, k->rebecs * sizeof *ids);
    construct_from(k, ids, rebec + 1);
    free(ids);
}

/* All outcomes from number `at` on, from a state. A body that fails by an overflow has run only up
 * to there: what it would have chosen afterwards makes no further steps. */
static void follow_all(struct kernel *k, const uint32_t *ids, uint32_t rebec, uint32_t at)
{
    int64_t cut = -1;
    for (int last = 0; !last; at++) {
        struct outcome o = *outcome(k, at);
        last = (int)o.last;
        glance(k, STORING);
        if (cut >= 0 && o.shared >= cut)
            continue;
        cut = -1;
        memcpy(k->next, ids, k->rebecs * sizeof *ids);
        const struct send *overflow = deliver(k, &o);
        if (overflow) {
            cut = overflow->choices;
            fail(k, (int32_t)rebec, OVERFLOW, (int32_t)overflow->pc, (int32_t)overflow->receiver);
        } else if (o.failure) {
            fail(k, (int32_t)rebec, o.failure, o.pc, (int32_t)rebec);
        } else {
            k->next[rebec] = o.component;
            follow(k, rebec);
        }
    }
}

static void construct_from(struct kernel *k, const uint32_t *ids, uint32_t rebec)
{
    if (rebec == k->rebecs) {
        memcpy(k->next, ids, k->rebecs * sizeof *ids);
        complete(k, -1);
        return;
    }
    uint32_t first = construct(k, rebec, ids[rebec]);
    if (first == NONE)
        longjmp(k->escape->to, UNENDING);
    follow_all(k, ids, rebec, first);
}

/* When nobody can act, the exact view lets time pass. */
static void idle(struct kernel *k)
{
    int64_t time = k->semantics == TTS ? least_next(k, k->ids) : NEVER;
    if (time == NEVER)
        return;
    memcpy(k->next, k->ids, k->rebecs * sizeof *k->ids);
    pass(k, time);
    reach(k, -1, time, 0);
}

/* Makes sure that the outcomes of a rebec that can act are known; 0 when a body does not end. */
static int know(struct kernel *k, uint32_t rebec)
{
    if (component(k, rebec, k->ids[rebec])->outcomes == NONE)
        produce(k, rebec, k->ids[rebec]);
    return !(component(k, rebec, k->ids[rebec])->flags & STUCK);
}

static int fails(struct kernel *k, uint32_t rebec)
{
    const struct outcome *o;
    uint32_t at = component(k, rebec, k->ids[rebec])->outcomes;
    do {
        o = outcome(k, at++);
        memcpy(k->next, k->ids, k->rebecs * sizeof *k->ids);
        if (deliver(k, o) || o->failure)
            return 1;
    } while (!o->last);
    return 0;
}

static int is_able(struct kernel *k, uint32_t rebec)
{
    return (component(k, rebec, k->ids[rebec])->flags & ABLE) != 0;
}

/* Whether a rebec that can act disturbs another, by the marks of that one. */
static int is_disturbed(struct kernel *k, const int32_t *disturbs)
{
    for (uint32_t r = 0; r < k->rebecs; r++)
        if (disturbs[r] && is_able(k, r))
            return 1;
    return 0;
}

/* Lets one rebec act alone whose steps are a persistent set: -1 none is, 0 a body does not end. */
static int expand_persistent(struct kernel *k)
{
    for (uint32_t i = 0; i < k->persistent_count; i++) {
        const int32_t *candidate = k->persistent + (size_t)i * (k->rebecs + 1);
        uint32_t r = (uint32_t)candidate[0];
        if (!is_able(k, r) || is_disturbed(k, candidate + 1))
            continue;
        if (!know(k, r))
            return 0;
        if (!fails(k, r)) {
            follow_all(k, k->ids, r, component(k, r, k->ids[r])->outcomes);
            return 1;
        }
    }
    return -1;
}

/* The steps of so many rebecs that act. */
static int expand_acting(struct kernel *k, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!know(k, k->acting[i]))
            return 0;
    for (uint32_t i = 0; i < count; i++)
        follow_all(k, k->ids, k->acting[i], component(k, k->acting[i], k->ids[k->acting[i]])->outcomes);
    return 1;
}

/* Makes all steps of the state k->ids, those of the best rank; 0 when a body in it does not end. */
static int expand(struct kernel *k)
{
    int32_t best = INT32_MAX;
    uint32_t count = 0;
    k->ordinal = 0;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        const struct component *c = component(k, r, k->ids[r]);
        if (!(c->flags & ABLE) || c->rank > best)
            continue;
        count = c->rank < best ? 0 : count;
        best = c->rank;
        k->acting[count++] = r;
    }
    if (!count) {
        idle(k);
        return 1;
    }
    int alone = k->persistent_count ? expand_persistent(k) : -1;
    return alone >= 0 ? alone : expand_acting(k, count);
}

#endif
