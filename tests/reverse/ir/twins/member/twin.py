class Robot:
    def __init__(self, speed: int) -> None:
        self.speed_ = speed
        self.moves_ = 0

    def move(self, by: int) -> None:
        if self.speed_ + by > 10:
            return
        self.speed_ += by
        self.moves_ += 1

    def state(self) -> int:
        return self.speed_ * 100 + self.moves_


def f(start: int, by: int) -> int:
    robot = Robot(start)
    robot.move(by)
    robot.move(by)
    return robot.state()
